// Pinned futures that are none of the drawn ones: in ink, with the pin at their end; dashed, with the reason, where
// they no longer fit.
import { pill, type Labels } from '../../draw/labels';
import type { Pen } from '../../draw/pen';
import { lastInView, trail } from '../../draw/strokes';
import { colours } from '../../draw/theme';
import type { View } from '../../draw/view';
import type { ShownPin } from '../moves/pins';

const MISFIT_DASH = [7, 6];

export function paintPins(g: Pen, v: View, pins: readonly ShownPin[], dim: boolean): void {
  const c = colours();
  for (const { motion, why } of pins)
    trail(g, v, motion, {
      colour: c['ink-2'],
      width: 2.5,
      alpha: dim ? 0.25 : why ? 0.75 : 1,
      halo: true,
      dots: why === null,
      dash: why ? MISFIT_DASH : [],
      cap: why ? 'butt' : 'round',
    });
}

export function paintPinWords(g: Pen, labels: Labels, v: View, pins: readonly ShownPin[]): void {
  const c = colours();
  for (const { pin, motion, why } of pins) {
    const end = lastInView(v, motion);
    if (!end) continue;
    const style = { icon: 'pin', border: c['ink-3'], leader: c['ink-3'], radii: [20, 32, 48, 68] } as const;
    pill(g, labels, end[0], end[1], why ?? pin.name, why ? { ...style, fg: c['ink-2'] } : style);
  }
}
