// Screen positions of the arm handles while an area is filled: further outward means more arrivals.
import type { Vec } from '../../../model/base/geometry';
import type { View } from '../../../draw/view';
import type { EntryArm } from './filling';

/** From zero to the arm's capacity, pixels. */
const TRAVEL_PX = 110;
/** Distance of the handle of an arm without traffic inside the map's edge, pixels. */
const INSIDE_PX = 34;
/** Least distance of handles from the edge of the picture, pixels. */
const EDGE_PX = 30;
/** Vehicles per hour for each step of a drag. */
export const RATE_STEP = 20;

export interface ArmHandle {
  readonly arm: EntryArm;
  readonly rate: number;
  /** The handle's place without traffic, and its place now, in pixels. */
  readonly base: Vec;
  readonly at: Vec;
  /** Outward, of length one, in pixels. */
  readonly out: Vec;
}

/** Handles of the arms inside the picture. */
export function armHandles(arms: readonly EntryArm[], rates: Readonly<Record<string, number>>, v: View): ArmHandle[] {
  return arms.flatMap((arm) => {
    if (!v.shows(...arm.at, EDGE_PX)) return [];
    const [x, y] = v.to(...arm.at);
    const inward = v.ahead(arm.heading);
    const out: Vec = [-inward[0], -inward[1]];
    const rate = rates[arm.id] ?? 0;
    // Moved inwards so that the longest stem stays in the picture.
    const { left, right, top, bottom } = v.inset;
    const over = Math.max(
      INSIDE_PX,
      over1(x + out[0] * TRAVEL_PX, left + EDGE_PX, v.w - right - EDGE_PX) / Math.max(0.3, Math.abs(out[0])),
      over1(y + out[1] * TRAVEL_PX, top + EDGE_PX, v.h - bottom - EDGE_PX) / Math.max(0.3, Math.abs(out[1])),
    );
    const base: Vec = [x - out[0] * over, y - out[1] * over];
    const far = (TRAVEL_PX * rate) / arm.most;
    return [{ arm, rate, base, at: [base[0] + out[0] * far, base[1] + out[1] * far], out }];
  });
}

/** Distance of a value outside a range. */
const over1 = (p: number, least: number, most: number): number => Math.max(0, least - p, p - most);

/** Vehicles per hour after a drag outward, pixels. */
export function rateAfter(before: number, px: number, { most }: EntryArm): number {
  const rate = Math.round((before + (px / TRAVEL_PX) * most) / RATE_STEP) * RATE_STEP;
  return Math.min(Math.floor(most / RATE_STEP) * RATE_STEP, Math.max(0, rate));
}

/** The handle at a screen position; null where there is none. */
export function armHandleAt(all: readonly ArmHandle[], x: number, y: number, reach: number): ArmHandle | null {
  const far = (h: ArmHandle): number => Math.hypot(h.at[0] - x, h.at[1] - y);
  return all.filter((h) => far(h) <= reach).sort((a, b) => far(a) - far(b))[0] ?? null;
}
