import { plural, table } from '../table';

export const TEXTS = table('history', {
  history: 'History',
  ofSteps: (at: number, count: number) => `${at} of ${count} steps`,
  noStepsYet: 'no steps yet',
  olderSteps: (count: number) => plural(count, { one: `${count} older step`, other: `${count} older steps` }),
  oneBack: 'one step back',
  keptOnThisComputer: 'Stored on this computer',
  initialState: 'Initial state',
  beforeTheFirst: 'before the first step',
  goBackToThis: 'go back to this step',
  branch: 'branch',
  named: 'named',
  nameThisStep: 'Name this step',
  nameTheStep: (step: string) => `Name the step ${step}`,
  nameOfTheStep: 'Name of the step',
  now: 'now',
});
