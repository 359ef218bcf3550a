import { table } from '../table';

export const TEXTS = table('parts', {
  noSeed: (typed: string) => `“${typed}” is no seed: that is a whole number.`,
  seed: 'Seed',
  diversity: 'Diversity',
  waiting: 'Waiting …',
  generate: 'Generate',
  howFarTheSix: 'How far the six may differ',
  react: 'React',
  replayLog: 'Replay log',
  goOn: 'Go on',
  holdStill: 'Hold still',
  everybodyYou: 'Everybody adapts when you let go; who has a goal still meets it.',
  theyDoWhatWas: 'They do what was recorded; who was put here goes on as it did.',
  theyStayWhere: 'They stay where they start, and nobody else comes in.',
});
