// Saves the feedback of rounds as a file.
import { oneSubject } from '../../../model/document/feedback-commands';
import { feedbackTable } from '../../../model/words/feedback-table';
import { nameIn } from '../../../model/document/scene';
import { save, slug } from '../outward/download';
import type { Deck } from './deck';
import type { Editor } from '../../session/editor';

/** For the subject of the rounds, otherwise the selected road user, as a table. */
export function saveFeedback(editor: Editor, deck: Deck): void {
  const [scene, one] = [editor.scene.peek(), editor.agent.peek()];
  const a = deck.subject.peek() ?? (one && oneSubject(one));
  if (!scene || !a?.feedback) return;
  const text = feedbackTable(a.id, a.feedback, nameIn(scene));
  const blob = new Blob([text], { type: 'text/csv' });
  save(editor, { blob, name: `${slug(scene.name)}-rounds-${slug(a.name)}.csv`, losses: [] });
}
