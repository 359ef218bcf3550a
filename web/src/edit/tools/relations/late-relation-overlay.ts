// Loads the painter of relations when a road user with one is selected, or one is offered; once loaded the picture is
// painted again.
import type { Labels, Rect } from '../../../draw/labels';
import type { Pen } from '../../../draw/pen';
import type { View } from '../../../draw/view';
import type { Agent } from '../../../model/document/scene';
import type { ToolHandle } from '../../gestures/chart';
import { inRect } from '../../gestures/hit';
import { Panning } from '../../gestures/panning';
import type { ToolOverlay } from '../../overlay/tool-overlay';
import type { Editor } from '../../session/editor';
import type { GapOffer } from './gap-offer';

export class LateRelationOverlay implements ToolOverlay {
  #painters: Pick<typeof import('./relation-overlay'), 'paintRelation' | 'paintOffer'> | null = null;
  /** Painted place of the offer's words, for the pointer. */
  #offered: Rect | null = null;
  coming = false;

  constructor(
    private readonly editor: Editor,
    private readonly offer: GapOffer,
  ) {}

  watch(): void {
    void this.editor.scene.value;
    void this.offer.now.value;
  }

  /** Its own relation, and those of others to it; else the gap that can be held. */
  paintSelected(g: Pen, v: View, labels: Labels, a: Agent): void {
    this.#offered = null;
    const related = [...this.editor.scene.value!.agents.values()].filter(
      ({ id, goal: { relation } }) => relation && (id === a.id || relation.to === a.id),
    );
    const offer = this.editor.playhead.playing.value ? null : this.offer.now.value;
    if (!related.length && !offer) return;
    const painters = this.#painters;
    if (painters) {
      for (const of of related) painters.paintRelation(g, v, labels, this.editor, of);
      if (offer) this.#offered = painters.paintOffer(g, v, labels, this.editor, a, offer);
    } else if (!this.coming) {
      this.coming = true;
      void import('./relation-overlay')
        .then((all) => (this.#painters = all))
        // The panel has the relation in words; the next picture tries again.
        .catch(() => null)
        .finally(() => (this.coming = false));
    }
  }

  handleAt(x: number, y: number): ToolHandle | null {
    if (!this.#offered || !this.offer.now.peek() || !inRect(this.#offered, x, y)) return null;
    return {
      cursor: 'pointer',
      drag: (chart, press) => new Panning(chart, press),
      click: () => this.offer.accept(),
    };
  }
}
