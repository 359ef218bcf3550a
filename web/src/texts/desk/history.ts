import { table } from '../table';

export const TEXTS = table('history', {
  history: 'History',
  ofSteps: (at: number, count: number) => `${at} of ${count} steps`,
  nothingDoneYet: 'nothing done yet',
  olderSteps: (count: number) => `${count} older steps`,
  oneBack: 'one back',
  keptOnThisComputer: 'Kept on this computer',
  howItWas: 'How it was',
  beforeTheFirst: 'before the first step',
  goBackToThis: 'go back to this one',
  branch: 'branch',
  named: 'named',
  nameThisStep: 'Name this step',
  nameTheStep: (step: string) => `Name the step ${step}`,
  nameOfTheStep: 'Name of the step',
  now: 'now',
});
