// Behaviour of the others while one is changed.
import { useComputed } from '@preact/signals';
import type { Others } from '../../model/document/scene';
import { TEXTS } from '../../texts/desk/parts';
import { useApp } from './app-context';

type Choices = readonly (readonly [string, string])[];

const choices = (log: string): Choices => [
  ['others-react', TEXTS.react],
  ['others-log', log],
  ['others-still', TEXTS.holdStill],
];
const RECORDED = choices(TEXTS.replayLog);
const PLACED = choices(TEXTS.continueAsNow);

/** Choices for the others, as pairs of action and word. If all were placed there is no recording to replay. */
export function useOthers(): Choices {
  const { editor } = useApp();
  return useComputed(() => {
    const all = [...(editor.resting.value?.agents.values() ?? [])];
    return all.length && all.every((a) => a.placed) ? PLACED : RECORDED;
  }).value;
}

/** The meaning of each. */
export const OTHERS_DO: Readonly<Record<Others, string>> = {
  react: TEXTS.allReactOnRelease,
  log: TEXTS.recordedReplay,
  still: TEXTS.othersHoldStill,
};
