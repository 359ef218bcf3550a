// What was said of the cards on the table.
import { answerTo, type Answer } from '../../model/feedback';
import type { Editor } from '../editor';

const NONE: readonly null[] = Object.freeze([]);

/** By card; null where it is open. */
export function saidOf({ deck, scene }: Editor): readonly (Answer | null)[] {
  const hand = deck.hand.value;
  const a = hand && scene.value?.agents.get(hand.id);
  return a ? hand.round.cards.map((card) => answerTo(a.feedback, hand.asked, card)) : NONE;
}
