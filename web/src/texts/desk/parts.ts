import { table } from '../table';

export const TEXTS = table('parts', {
  noSeed: (typed: string) => `“${typed}” is not a seed: enter a whole number.`,
  seed: 'Seed',
  diversity: 'Diversity',
  waiting: 'Waiting …',
  generate: 'Generate',
  howFarTheSix: 'How much the six futures may differ',
  react: 'React',
  replayLog: 'Replay log',
  goOn: 'Continue',
  holdStill: 'Hold still',
  everybodyYou: 'All road users react on release; goals are still met.',
  theyDoWhatWas: 'Recorded road users replay the log; placed ones continue unchanged.',
  theyStayWhere: 'Others stay at their start; no others arrive.',
});
