// Pinned futures of the selected road user, as the page shows them.
import { LETTERS } from '../../model/document/futures';
import { indexOfPin, MOST_PINS, motionOfPin, pinFuture, pinOf, unpin } from '../../model/document/pins';
import { misfit } from '../../model/words/pin-words';
import type { Command } from '../../model/document/commands';
import type { Motion } from '../../model/base/motion';
import type { Agent, Pin } from '../../model/document/scene';
import type { Editor } from '../session/editor';
import { TEXTS } from '../../texts/editing/pins';

export interface ShownPin {
  readonly pin: Pin;
  readonly motion: Motion;
  /** Why it fits no more; null where it does. */
  readonly why: string | null;
}

/** Those that are none of the futures that are shown: these carry the mark themselves. */
export function pinsApart(editor: Pick<Editor, 'agent' | 'reading' | 'view'>): readonly ShownPin[] {
  const a = editor.agent.value;
  if (!a?.pins.length || editor.reading.cards.ofAgent(a.id)) return [];
  const f = editor.reading.futures.value;
  const apart = a.pins.filter((pin) => indexOfPin(f, pin) < 0);
  return apart.map((pin) => ({ pin, motion: motionOfPin(pin), why: misfit(a, pin, editor.view.unitOf(a)) }));
}

/** The pinned one that a future is. */
export function pinnedAt(editor: Pick<Editor, 'agent' | 'reading' | 'view'>, index: number): Pin | null {
  const a = editor.agent.value;
  return a?.pins.length && !editor.reading.cards.ofAgent(a.id)
    ? pinOf(a, editor.reading.futures.value?.modes[index])
    : null;
}

/** Pins a future, or lets it go; words say why that cannot be. */
export function togglePin(
  editor: Pick<Editor, 'agent' | 'reading' | 'view'>,
  a: Agent,
  index: number,
): Command | string {
  const f = editor.reading.futures.peek();
  const m = f?.modes[index];
  if (!m || f.sketch || editor.reading.cards.ofAgent(a.id)) return TEXTS.selectFirst;
  const pin = pinOf(a, m);
  if (pin) return unpin(a, pin);
  return a.pins.length < MOST_PINS ? pinFuture(a, m, LETTERS[index]) : TEXTS.atMost(MOST_PINS);
}
