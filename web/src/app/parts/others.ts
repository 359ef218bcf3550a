// What the others do while one is changed.
import type { Others } from '../../model/scene';
import { TEXTS } from '../../texts/parts';

/** What the others do, as pairs of action and word. */
export const OTHERS: readonly (readonly [string, string])[] = [
  ['others-react', TEXTS.react],
  ['others-log', TEXTS.replayLog],
  ['others-still', TEXTS.holdStill],
];

/** What that means. */
export const OTHERS_DO: Readonly<Record<Others, string>> = {
  react: TEXTS.everybodyYou,
  log: TEXTS.theyDoWhatWas,
  still: TEXTS.theyStayWhere,
};
