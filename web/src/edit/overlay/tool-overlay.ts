// Overlay of a tool.
import type { Labels } from '../../draw/labels';
import type { Pen } from '../../draw/pen';
import type { View } from '../../draw/view';
import type { Agent } from '../../model/document/scene';

export interface ToolOverlay {
  /** Reads the signals it depends on: a change paints it again. */
  watch(): void;
  paint?(g: Pen, v: View, labels: Labels): void;
  /** With the selected road user, under its words. */
  paintSelected?(g: Pen, v: View, labels: Labels, a: Agent): void;
  /** Is it painted in place of the scene? */
  readonly isAlone?: boolean;
  /** Is a part still loading? Then the overlay needs another frame. */
  readonly coming?: boolean;
  /** Is the followed future the only answer? Then no verdicts of the others are shown. */
  readonly isDecided?: boolean;
}
