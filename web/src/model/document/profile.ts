// A drawn speed profile: points of speed over time on a fixed path.

/** A speed at a time, m/s and s; from then on held for this many seconds. */
export interface SpeedPoint {
  readonly t: number;
  readonly v: number;
  readonly hold: number;
}

/** Positions with a heading, some distance apart. */
export interface Path {
  readonly x: readonly number[];
  readonly y: readonly number[];
  readonly heading: readonly number[];
}

/** The first point is the start; points are in order of time. */
export interface Profile {
  readonly path: Path;
  readonly points: readonly SpeedPoint[];
}

/** The most points of one curve. */
export const MOST_POINTS = 12;

/** Reads a profile from a file; null where it is invalid. */
export function readProfile(v: unknown): Profile | null {
  const p = v as Partial<Profile> | null | undefined;
  const numbers = (a: unknown): a is number[] => Array.isArray(a) && a.length > 0 && a.every((n) => Number.isFinite(n));
  const { x, y, heading } = p?.path ?? {};
  if (!numbers(x) || !numbers(y) || !numbers(heading) || x.length !== y.length || x.length !== heading.length)
    return null;
  const points = Array.isArray(p?.points) ? p.points : [];
  const fine = points.every((q, i) => {
    const ok = q !== null && [q.t, q.v, q.hold].every((n) => Number.isFinite(n) && n >= 0);
    return ok && (i ? q.t > points[i - 1].t : q.t === 0);
  });
  return fine && points.length > 0 && points.length <= MOST_POINTS ? freeze(p as Profile) : null;
}

const freeze = (p: Profile): Profile => Object.freeze({ path: p.path, points: p.points });
