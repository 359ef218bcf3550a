import { table } from '../table';

export const TEXTS = table('parts', {
  noSeed: (typed: string) => `“${typed}” is not a seed: enter a whole number.`,
  seed: 'Seed',
  diversity: 'Diversity',
  length: 'Length',
  computedLength: 'Computed length',
  replanEvery: 'Replan every',
  planningWindow: 'Planning window of all road users',
  resultCode: 'Result code',
  howFarTheSix: 'How much the six futures may differ',
  react: 'React',
  replayLog: 'Replay log',
  continueAsNow: 'Continue',
  holdStill: 'Hold still',
  allReactOnRelease: 'All road users react on release; goals are still met.',
  recordedReplay: 'Recorded road users replay the log; placed ones continue unchanged.',
  othersHoldStill: 'Others stay at their start; no others arrive.',
});
