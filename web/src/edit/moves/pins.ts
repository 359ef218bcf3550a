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
  /** Why it no longer fits; null where it does. */
  readonly why: string | null;
}

/** Pinned futures that are none of the shown ones; a shown one carries the mark itself. */
export function pinsApart(editor: Pick<Editor, 'agent' | 'reading' | 'view'>): readonly ShownPin[] {
  const a = editor.agent.value;
  if (!a?.pins.length || editor.reading.cards.ofAgent(a.id)) return [];
  const f = editor.reading.futures.value;
  const apart = a.pins.filter((pin) => indexOfPin(f, pin) < 0);
  return apart.map((pin) => ({ pin, motion: motionOfPin(pin), why: misfit(a, pin, editor.view.unitOf(a)) }));
}

/** The pin of a future. */
export function pinnedAt(editor: Pick<Editor, 'agent' | 'reading' | 'view'>, index: number): Pin | null {
  const a = editor.agent.value;
  return a?.pins.length && !editor.reading.cards.ofAgent(a.id)
    ? pinOf(a, editor.reading.futures.value?.modes[index])
    : null;
}

/** Pins or unpins a future; returns why that is not possible. */
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
