// Drawn speed profiles, with draggable stops.
import type { Feature } from '../feature';
import { SpeedCurve } from './speed-curve';
import { StopBars } from './stop-bars';

export const SPEED_CURVE = {
  make({ editor }) {
    const curve = new SpeedCurve(editor);
    const bars = new StopBars(editor, curve);
    return { named: { curve }, overlay: bars, handleAt: (x, y, touch) => bars.handleAt(x, y, touch) };
  },
} satisfies Feature;
