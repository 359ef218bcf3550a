/** What the others do, as pairs of action and word. */
export const OTHERS: readonly (readonly [string, string])[] = [
  ['others-react', 'React'],
  ['others-log', 'Replay log'],
  ['others-still', 'Hold still'],
];
