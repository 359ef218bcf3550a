// Behaviour of the others while one is changed.
import { useComputed } from '@preact/signals';
import type { Others } from '../../model/document/scene';
import { TEXTS } from '../../texts/desk/parts';
import { useApp } from './app-context';

type OthersWords = Readonly<Record<Others, string>>;

const RECORDED: OthersWords = { react: TEXTS.react, log: TEXTS.replayLog, still: TEXTS.holdStill };
const PLACED: OthersWords = { ...RECORDED, log: TEXTS.continueAsNow };

/** What the others do, in a word. If all were placed there is no recording to replay. */
export function useOthersWord(): string {
  const { editor } = useApp();
  return useComputed(() => {
    const scene = editor.resting.value;
    const all = [...(scene?.agents.values() ?? [])];
    const words = all.length && all.every((a) => a.placed) ? PLACED : RECORDED;
    return words[scene?.others ?? 'react'];
  }).value;
}

/** The meaning of each. */
export const OTHERS_DO: OthersWords = {
  react: TEXTS.allReactOnRelease,
  log: TEXTS.recordedReplay,
  still: TEXTS.othersHoldStill,
};
