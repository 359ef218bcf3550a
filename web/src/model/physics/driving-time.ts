// The least time that a road user takes along a line without haste: within the speed limits, and without harsh braking,
// steering or running.
import { limitsOf, PLANNING, type Typed } from '../base/domain';
import { radii, type Route } from './lane-routes';

// View only: the time that a remedy offers, before the server has tried it. Limits, manners and the speed of walkers
// are the server's.

/** Moving off takes a moment even for a road user that has almost no way to go, m/s. */
const LEAST_MPS = 0.5;

/** A route along lanes, or a plain curve without any. */
export type DrivenRoute = Pick<Route, 'line' | 'lanes' | 'ends'>;

/** Seconds from speed `v` (m/s), ending at most at speed `end`. */
export function drivingTime(a: Typed, { line, lanes, ends }: DrivenRoute, v: number, end = Infinity): number {
  const { speed_mps, hurried: manner } = limitsOf(a);
  const onFoot = a.type === 'pedestrian';
  const own = onFoot ? PLANNING.walking_mps : speed_mps;
  const limitAt = (s: number): number => lanes[ends.findIndex((end) => s <= end)]?.limit ?? Infinity;
  const bends = onFoot ? [] : radii(line);
  const n = Math.max(2, Math.floor(line.length / 2));
  const step = line.length / n;
  const most = Array.from({ length: n + 1 }, (_, i) =>
    Math.min(own, limitAt(i * step), Math.sqrt(manner.lateral_mps2 * (bends[i] ?? Infinity))),
  );
  most[n] = Math.min(most[n], end);
  for (let i = n - 1; i >= 0; i--)
    most[i] = Math.min(most[i], Math.sqrt(most[i + 1] ** 2 + 2 * manner.brake_mps2 * step));
  let time = 0;
  let now = v;
  for (let i = 1; i <= n; i++) {
    const faster = Math.sqrt(now ** 2 + 2 * manner.accel_mps2 * step);
    const slower = Math.sqrt(Math.max(0, now ** 2 - 2 * manner.brake_mps2 * step));
    const next = Math.max(slower, Math.min(faster, most[i]));
    time += step / Math.max(LEAST_MPS, (now + next) / 2);
    now = next;
  }
  return time;
}
