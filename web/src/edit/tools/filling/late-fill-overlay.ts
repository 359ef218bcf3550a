// Loads the painter of a filled area on demand; once loaded the picture is painted again.
import type { Labels } from '../../../draw/labels';
import type { Pen } from '../../../draw/pen';
import type { View } from '../../../draw/view';
import { TEXTS } from '../../../texts/editing/picture';
import type { ToolOverlay } from '../../overlay/tool-overlay';
import type { Editor } from '../../session/editor';
import type { FillOverlay } from './fill-overlay';
import type { Filling } from './filling';

export class LateFillOverlay implements ToolOverlay {
  #overlay: FillOverlay | null = null;
  coming = false;

  constructor(
    private readonly editor: Pick<Editor, 'notices' | 'scene'>,
    private readonly filling: Filling,
  ) {}

  watch(): void {
    const { answer, drawn, wish } = this.filling;
    void [answer.value, drawn.value, wish.value];
  }

  paint(g: Pen, v: View, labels: Labels): void {
    if (!this.filling.wish.value) return;
    if (this.#overlay) this.#overlay.paint(g, v);
    else if (!this.coming) {
      this.coming = true;
      void import('./fill-overlay')
        .then(({ FillOverlay }) => (this.#overlay = new FillOverlay(this.editor, this.filling, labels)))
        .catch(() => this.editor.notices.show({ text: TEXTS.thePreviewDid }))
        .finally(() => (this.coming = false));
    }
  }
}
