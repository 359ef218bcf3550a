// Pinned futures of the selected road user, as the page shows them.
import { LETTERS } from '../model/document/futures';
import { indexOfPin, MOST_PINS, motionOfPin, pinFuture, pinOf, unpin } from '../model/document/pins';
import { misfit } from '../model/words/pin-words';
import type { Command } from '../model/document/commands';
import type { Motion } from '../model/base/motion';
import type { Agent, Pin } from '../model/document/scene';
import type { Editor } from './editor';
import { TEXTS } from '../texts/editing/pins';

export interface ShownPin {
  readonly pin: Pin;
  readonly motion: Motion;
  /** Why it fits no more; null where it does. */
  readonly why: string | null;
}

/** Those that are none of the futures that are shown: these carry the mark themselves. */
export function pinsApart(editor: Editor): readonly ShownPin[] {
  const a = editor.agent.value;
  if (!a?.pins.length || editor.deck.ofAgent(a.id)) return [];
  const f = editor.futures.value;
  const apart = a.pins.filter((pin) => indexOfPin(f, pin) < 0);
  return apart.map((pin) => ({ pin, motion: motionOfPin(pin), why: misfit(a, pin, editor.unitOf(a)) }));
}

/** The pinned one that a future is. */
export function pinnedAt(editor: Editor, index: number): Pin | null {
  const a = editor.agent.value;
  return a?.pins.length && !editor.deck.ofAgent(a.id) ? pinOf(a, editor.futures.value?.modes[index]) : null;
}

/** Pins a future, or lets it go; words say why that cannot be. */
export function togglePin(editor: Editor, a: Agent, index: number): Command | string {
  const f = editor.futures.peek();
  const m = f?.modes[index];
  if (!m || f.sketch || editor.deck.ofAgent(a.id)) return TEXTS.selectFirst;
  const pin = pinOf(a, m);
  if (pin) return unpin(a, pin);
  return a.pins.length < MOST_PINS ? pinFuture(a, m, LETTERS[index]) : TEXTS.atMost(MOST_PINS);
}
