// A picked future is not judged anew with the answers of the others to it: what it does by itself stays as it was
// judged, and whom it hits or nearly hits is what the score of the whole scene says.
import { FAULT_KINDS, type Fault } from './about';
import type { Collision, Future, NearMiss, Score } from './futures';
import type { FaultJson } from './json';
import { poseAt } from './motion';

/** Meetings of the same two closer together than this are one. */
const SAME_S = 1.5;

const meets = (f: Pick<Fault, 'kind'>): boolean => f.kind === 'collision' || f.kind === 'near_miss';

/** The future of `id` with the meetings that the score knows, and no others. */
export function withMeetingsOf(score: Score, id: string, f: Future): Future {
  if (!f.about) return f;
  const old = f.about.faults.filter(meets);
  const hits = score.collisions.flatMap((c) => meeting(f, id, 'collision', c, c.closing ?? null, old) ?? []);
  const hit = new Set(hits.map((x) => x.with));
  const near = score.nearMisses
    .flatMap((c: NearMiss) => meeting(f, id, 'near_miss', c, c.distance, old) ?? [])
    .filter((x) => !hit.has(x.with));
  const now = [...new Set([...hits, ...near])];
  if (now.length === old.length && now.every((x) => old.includes(x))) return f;
  const rank = (x: Fault): number => FAULT_KINDS.indexOf(x.kind);
  const faults = [...f.about.faults.filter((x) => !meets(x)), ...now];
  faults.sort((a, b) => rank(a) - rank(b) || a.time - b.time);
  return { ...f, about: { ...f.about, faults }, sent: { ...f.sent, faults: faults.map(faultJson) } };
}

/** Null for a meeting of others, or one where the future knows no place. */
function meeting(
  f: Future,
  id: string,
  kind: 'collision' | 'near_miss',
  c: Collision,
  extent: number | null,
  old: readonly Fault[],
): Fault | null {
  if (c.inLog || (c.a !== id && c.b !== id)) return null;
  const other = c.a === id ? c.b : c.a;
  const same = (x: Fault): boolean =>
    x.kind === kind && x.with === other && c.time > x.time - SAME_S && c.time < x.until + SAME_S;
  const known = old.find(same);
  if (known) return known;
  const p = poseAt(f.motion, c.time);
  return p && { kind, time: c.time, until: c.time, at: [p.x, p.y], extent, with: other, edge: null };
}

const faultJson = (f: Fault): FaultJson => ({
  kind: f.kind,
  time_s: f.time,
  until_s: f.until,
  x_m: f.at[0],
  y_m: f.at[1],
  extent: f.extent,
  with: f.with,
  ...(f.edge === null ? {} : { edge: f.edge }),
});
