// Via points of a road user on its way to its goal, in order.
import { VIAS } from '../base/domain';
import type { Vec } from '../base/geometry';
import { STEP_S, type Motion } from '../base/motion';

export interface Via {
  readonly pos: Vec;
  /** Largest passing distance, metres. */
  readonly tolerance: number;
  /** Passing time, seconds; null where free. */
  readonly time: number | null;
}

const { most, tolerance_m, default_tolerance_m, within_s } = VIAS;
export const MOST_VIAS = most;
export const VIA_TOLERANCE: readonly [number, number] = [tolerance_m[0], tolerance_m[1]];
/** Earliest time of a via point, and least time between the last one and the goal. */
export const LEAST_TIME_S = 0.5;
export const NO_VIAS: readonly Via[] = Object.freeze([]);

/** Positions to the decimetre, like handles; tolerances to the centimetre, for tenths of feet. */
const rounded = (v: number, steps: number): number => Math.round(v * steps) / steps;

export const via = (pos: Vec, tolerance = default_tolerance_m, time: number | null = null): Via =>
  Object.freeze({ pos: Object.freeze([pos[0], pos[1]] as const), tolerance, time });

export const heldTolerance = (m: number): number =>
  rounded(Math.min(VIA_TOLERANCE[1], Math.max(VIA_TOLERANCE[0], m)), 100);

/** The list with one changed; without it for null. */
export const withVia = (all: readonly Via[], i: number, patch: Partial<Via> | null): readonly Via[] =>
  Object.freeze(all.flatMap((v, k) => (k !== i ? [v] : patch ? [Object.freeze({ ...v, ...patch })] : [])));

/** Possible times of one: after those before it, before those after it and the goal. */
export function timesOf(all: readonly Via[], i: number, due: number): readonly [number, number] {
  const before = all.slice(0, i).flatMap((v) => v.time ?? []);
  const after = all.slice(i + 1).flatMap((v) => v.time ?? []);
  return [Math.max(LEAST_TIME_S, ...before.map((t) => t + 0.1)), Math.min(due - 0.1, ...after.map((t) => t - 0.1))];
}

/** The same with consistent times: one that is not before its successor becomes free. */
export function inOrder(all: readonly Via[], due: number): readonly Via[] {
  const kept = all.map((v, i) => {
    if (v.time === null) return v;
    const [least, latest] = timesOf(all, i, due);
    return v.time >= least - 1e-6 && v.time <= latest + 1e-6 ? v : Object.freeze({ ...v, time: null });
  });
  return kept.every((v, i) => v === all[i]) ? all : Object.freeze(kept);
}

export const shiftedVias = (all: readonly Via[], to: (x: number, y: number) => Vec): readonly Via[] =>
  all.length ? Object.freeze(all.map((v) => Object.freeze({ ...v, pos: Object.freeze(to(v.pos[0], v.pos[1])) }))) : all;

/** Time and distance of a motion's closest point to a place, seconds and metres; within a time range. */
export function nearestOn(m: Motion, [x, y]: Vec, from = 0, to = Infinity): { time: number; away: number } {
  let best = { time: from, away: Infinity };
  for (let i = 0; i + 1 < m.x.length; i++) {
    const at = (m.first + i) * STEP_S;
    if (at + STEP_S < from - 1e-6 || at > to + 1e-6) continue;
    const [dx, dy] = [m.x[i + 1] - m.x[i], m.y[i + 1] - m.y[i]];
    const len2 = dx * dx + dy * dy;
    const k = len2 > 0 ? Math.max(0, Math.min(1, ((x - m.x[i]) * dx + (y - m.y[i]) * dy) / len2)) : 0;
    const away = Math.hypot(m.x[i] + dx * k - x, m.y[i] + dy * k - y);
    if (away < best.away) best = { time: at + k * STEP_S, away };
  }
  return best;
}

/** Passing time and distance of each, and whether it is within the tolerance. */
export function passed(all: readonly Via[], m: Motion): { time: number; away: number; ok: boolean }[] {
  let from = 0;
  return all.map((v) => {
    const at = v.time === null ? nearestOn(m, v.pos, from) : nearestOn(m, v.pos, v.time - within_s, v.time + within_s);
    from = at.time;
    return { ...at, ok: at.away <= v.tolerance + 1e-3 };
  });
}

/** Index of a new one in the order along a motion: before the first that is passed later. */
export function placeIn(all: readonly Via[], m: Motion, pos: Vec): number {
  const { time } = nearestOn(m, pos);
  const i = passed(all, m).findIndex((p) => p.time > time);
  return i < 0 ? all.length : i;
}

export const withNew = (all: readonly Via[], i: number, added: Via): readonly Via[] =>
  Object.freeze([...all.slice(0, i), added, ...all.slice(i)]);

/** The readable via points of a file. */
export function readVias(json: unknown): readonly Via[] {
  if (!Array.isArray(json) || !json.length) return NO_VIAS;
  const all = json
    .slice(0, MOST_VIAS)
    .flatMap((v: { x_m?: unknown; y_m?: unknown; tolerance_m?: unknown; time_s?: unknown }) => {
      const finite = (n: unknown): n is number => typeof n === 'number' && Math.abs(n) <= 10_000;
      if (!v || !finite(v.x_m) || !finite(v.y_m)) return [];
      const tolerance = finite(v.tolerance_m)
        ? Math.min(VIA_TOLERANCE[1], Math.max(VIA_TOLERANCE[0], v.tolerance_m))
        : undefined;
      return [via([v.x_m, v.y_m], tolerance, finite(v.time_s) ? v.time_s : null)];
    });
  return Object.freeze(all);
}

export const viasJson = (all: readonly Via[]): { x_m: number; y_m: number; tolerance_m: number; time_s?: number }[] =>
  all.map((v) => ({
    x_m: v.pos[0],
    y_m: v.pos[1],
    tolerance_m: v.tolerance,
    ...(v.time === null ? {} : { time_s: v.time }),
  }));
