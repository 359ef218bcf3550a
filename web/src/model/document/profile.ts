// A speed curve drawn by hand: points of speed over time on a path that is kept as it was.

/** A speed at a time, m/s and s; from then on it is held for so many seconds. */
export interface SpeedPoint {
  readonly t: number;
  readonly v: number;
  readonly hold: number;
}

/** Places with a heading, some way apart. */
export interface Path {
  readonly x: readonly number[];
  readonly y: readonly number[];
  readonly heading: readonly number[];
}

/** The first point is the start; points lie in the order of their times. */
export interface Profile {
  readonly path: Path;
  readonly points: readonly SpeedPoint[];
}

/** The most points of one curve. */
export const MOST_POINTS = 12;

/** Reads what a file says; null for what is no profile. */
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
