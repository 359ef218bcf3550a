// What was said in rounds, as a file.
import { oneSubject } from '../../model/document/feedback-commands';
import { feedbackTable } from '../../model/words/feedback-table';
import { nameIn } from '../../model/document/scene';
import { save, slug } from '../download';
import type { Editor } from '../editor';
import { subjectOf } from './said';

/** Of those whom the rounds are about, else of the selected road user, as a table. */
export function saveFeedback(editor: Editor): void {
  const [scene, one] = [editor.scene.peek(), editor.agent.peek()];
  const a = subjectOf(editor) ?? (one && oneSubject(one));
  if (!scene || !a?.feedback) return;
  const text = feedbackTable(a.id, a.feedback, nameIn(scene));
  const blob = new Blob([text], { type: 'text/csv' });
  save(editor, { blob, name: `${slug(scene.name)}-rounds-${slug(a.name)}.csv`, losses: [] });
}
