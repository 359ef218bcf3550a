// What a tool paints over the picture.
import type { Labels } from '../../draw/labels';
import type { Pen } from '../../draw/pen';
import type { View } from '../../draw/view';
import type { Agent } from '../../model/document/scene';

export interface ToolOverlay {
  /** Reads what it is painted by: when that changes it is painted again. */
  watch(): void;
  paint?(g: Pen, v: View, labels: Labels): void;
  /** With the selected road user, under its words. */
  paintSelected?(g: Pen, v: View, labels: Labels, a: Agent): void;
  /** Is it painted in place of the scene? */
  readonly isAlone?: boolean;
  /** Is something of it still to come? It is to be painted again then. */
  readonly coming?: boolean;
  /** Is the future in force the only answer? Of the others nothing is said then. */
  readonly isDecided?: boolean;
}
