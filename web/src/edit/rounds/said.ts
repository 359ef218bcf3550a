// What was said of the cards on the table.
import { answerTo, type Answer } from '../../model/document/feedback';
import { everybody, oneSubject, type Subject } from '../../model/document/feedback-commands';
import type { Editor } from '../editor';

const NONE: readonly null[] = Object.freeze([]);

/** Whom the open rounds are about; null while they are closed, or when it has gone. */
export function subjectOf({ deck, scene }: Editor): Subject | null {
  const [of, now] = [deck.of.value, scene.value];
  if (!of || !now) return null;
  if (of.id === null) return everybody(now);
  const a = now.agents.get(of.id);
  return a ? oneSubject(a) : null;
}

/** By card; null where it is open. */
export function saidOf(editor: Editor): readonly (Answer | null)[] {
  const hand = editor.deck.hand.value;
  const of = hand && subjectOf(editor);
  return of ? hand.round.cards.map((card) => answerTo(of.feedback, hand.asked, card)) : NONE;
}
