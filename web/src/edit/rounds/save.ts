// What was said in rounds, as a file.
import { feedbackTable } from '../../model/feedback-table';
import { nameIn } from '../../model/scene';
import { save, slug } from '../download';
import type { Editor } from '../editor';

/** Of the selected road user, as a table. */
export function saveFeedback(editor: Editor): void {
  const [scene, a] = [editor.scene.peek(), editor.agent.peek()];
  if (!scene || !a?.feedback) return;
  const text = feedbackTable(a.id, a.feedback, nameIn(scene));
  const blob = new Blob([text], { type: 'text/csv' });
  save(editor, { blob, name: `${slug(scene.name)}-rounds-${slug(a.name)}.csv`, losses: [] });
}
