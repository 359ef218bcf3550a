// What the others do while one is changed.
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
const PLACED = choices(TEXTS.goOn);

/** What the others may do, as pairs of action and word. Where everybody was put here there is no log to be replayed. */
export function useOthers(): Choices {
  const { editor } = useApp();
  return useComputed(() => {
    const all = [...(editor.resting.value?.agents.values() ?? [])];
    return all.length && all.every((a) => a.placed) ? PLACED : RECORDED;
  }).value;
}

/** What that means. */
export const OTHERS_DO: Readonly<Record<Others, string>> = {
  react: TEXTS.everybodyYou,
  log: TEXTS.theyDoWhatWas,
  still: TEXTS.theyStayWhere,
};
