// Loads the painter of relations when a road user with one is selected; once loaded the picture is painted again.
import type { Labels } from '../../../draw/labels';
import type { Pen } from '../../../draw/pen';
import type { View } from '../../../draw/view';
import type { Agent } from '../../../model/document/scene';
import type { ToolOverlay } from '../../overlay/tool-overlay';
import type { Editor } from '../../session/editor';
import type { paintRelation } from './relation-overlay';

export class LateRelationOverlay implements ToolOverlay {
  #paint: typeof paintRelation | null = null;
  coming = false;

  constructor(private readonly editor: Editor) {}

  watch(): void {
    void this.editor.scene.value;
  }

  /** Its own relation, and those of others to it. */
  paintSelected(g: Pen, v: View, labels: Labels, a: Agent): void {
    const related = [...this.editor.scene.value!.agents.values()].filter(
      ({ id, goal: { relation } }) => relation && (id === a.id || relation.to === a.id),
    );
    if (!related.length) return;
    if (this.#paint) for (const of of related) this.#paint(g, v, labels, this.editor, of);
    else if (!this.coming) {
      this.coming = true;
      void import('./relation-overlay')
        .then(({ paintRelation }) => (this.#paint = paintRelation))
        // The panel has the relation in words; the next picture tries again.
        .catch(() => null)
        .finally(() => (this.coming = false));
    }
  }
}
