// What a lane is called at a junction: by its arm, and by what it does there. Where there is no junction, or more than
// one, compass words say more.
import { pointAt, type Vec } from '../base/geometry';
import { TEXTS } from '../../texts/scene/places';
import { turnOf, type Lane, type LaneMap } from '../document/lanemap';

/** A turn is one from here on, radians. */
const TURNS_RAD = 0.35;
/** Ways across within so many metres of a place are of one junction, and its arms begin within them. */
const JUNCTION_M = 45;
/** The junction that is meant has most of all ways across: those into a car park do not count. */
const MOST = 0.6;
/** More ways across than any one junction has. */
const MANY = 400;
/** So far out a lane is seen from the junction, metres. */
const OUT_M = 20;
/** Lanes so many before or after the junction are its arms. */
const FAR_LANES = 4;

const known = new WeakMap<LaneMap, { readonly centre: Vec | null; readonly names: Map<string, string | null> }>();

/** `W arm, left-turn lane`; null where compass words say more. */
export function armWords(map: LaneMap, lane: Lane): string | null {
  let of = known.get(map);
  if (!of) known.set(map, (of = { centre: mainJunction(map), names: new Map() }));
  if (!of.centre) return null;
  const name = of.names.get(lane.id);
  if (name !== undefined) return name;
  const words = lane.inside ? across(lane, of.centre) : named(map, lane, of.centre);
  of.names.set(lane.id, words);
  return words;
}

const middle = (l: Lane): Vec => {
  const p = pointAt(l.line, l.line.length / 2);
  return [p.x, p.y];
};

const near = (p: Vec, q: Vec): boolean => Math.hypot(p[0] - q[0], p[1] - q[1]) < JUNCTION_M;

/** The middle of the junction that most ways across belong to; null where there is none such. */
function mainJunction(map: LaneMap): Vec | null {
  const all = [...map.lanes.values()].filter((l) => l.inside).map(middle);
  // On a large map nobody waits for all pairs: it has more than one junction.
  if (!all.length || all.length > MANY) return null;
  const around = all.map((p) => all.filter((q) => near(p, q)));
  const most = around.reduce((a, b) => (b.length > a.length ? b : a));
  return most.length >= MOST * all.length ? meanOf(most) : null;
}

const meanOf = (all: readonly Vec[]): Vec => [mean(all.map((p) => p[0])), mean(all.map((p) => p[1]))];

const manner = (l: Lane): 'left' | 'right' | 'straight' => {
  const turn = turnOf(l.line);
  return turn > TURNS_RAD ? 'left' : turn < -TURNS_RAD ? 'right' : 'straight';
};

/** Those on the crossing that go straight on are lanes like others. */
function across(lane: Lane, junction: Vec): string | null {
  return near(middle(lane), junction) ? TEXTS.across[manner(lane)] : null;
}

function named(map: LaneMap, lane: Lane, junction: Vec): string | null {
  const outFrom = reach(map, lane, 'prev');
  const onTo = reach(map, lane, 'next');
  const away = outFrom.length && onTo.length ? leadsAway(lane, junction) : !onTo.length;
  const into = away ? [] : onTo;
  const ways = away ? outFrom : onTo;
  // A part of a ring is on no arm.
  if (away === null || !ways.length) return null;
  const centre = meanOf(ways.map(middle));
  if (!near(centre, junction)) return null;
  // Seen from the junction a place a little way out says which arm it is, however the road bends further out. At its
  // very end an outer lane of a wide road lies beside the arm.
  const { length } = lane.line;
  const at = pointAt(lane.line, into.length ? Math.max(0, length - OUT_M) : Math.min(length, OUT_M));
  const arm = TEXTS.arm(compass(Math.atan2(at.y - junction[1], at.x - junction[0])));
  if (lane.kind === 'bike') return TEXTS.bikeLane(arm);
  if (lane.type === 'bus_lane') return TEXTS.busLane(arm);
  const turns = new Set(into.map(manner));
  // Of a way into a roundabout nobody knows yet where it leads.
  const after = into.flatMap((l) => l.next.flatMap((id) => map.lanes.get(id) ?? []));
  const leadsOut = after.every((l) => !l.inside && leadsAway(l, junction) !== null);
  const one = turns.size === 1 && leadsOut ? [...turns][0] : null;
  if (one === 'left') return TEXTS.leftTurnLane(arm);
  if (one === 'right') return TEXTS.rightTurnLane(arm);
  return into.length ? TEXTS.inboundLane(arm) : TEXTS.outboundLane(arm);
}

/** A lane that comes no nearer to a place than this and gets no further from it leads round it, metres. */
const ROUND_M = 3;

/** Does a lane lead away from a place? Null where it leads round it. */
function leadsAway({ line }: Lane, from: Vec): boolean | null {
  const far = (at: number): number => {
    const p = pointAt(line, at);
    return Math.hypot(p.x - from[0], p.y - from[1]);
  };
  const by = far(line.length) - far(0);
  return Math.abs(by) < ROUND_M ? null : by > 0;
}

const mean = (v: readonly number[]): number => v.reduce((s, x) => s + x, 0) / v.length;

/** The ways across that a lane leads to, or comes from, over a few lanes. */
function reach(map: LaneMap, lane: Lane, way: 'next' | 'prev'): Lane[] {
  let now: Lane[] = [lane];
  for (let n = 0; n < FAR_LANES && now.length; n++) {
    const next = now.flatMap((l) => l[way].flatMap((id) => map.lanes.get(id) ?? []));
    const inside = next.filter((l) => l.inside);
    if (inside.length) return inside;
    now = next;
  }
  return [];
}

const ARMS = TEXTS.arms;
const COMPASS = [TEXTS.e, TEXTS.ne, TEXTS.n, TEXTS.nw, TEXTS.w, TEXTS.sw, TEXTS.s, TEXTS.se] as const;

function compass(angle: number): string {
  return COMPASS[((Math.round((angle * 4) / Math.PI) % 8) + 8) % 8];
}

/** The server's words for an arm, `North-west 2`, in those of the page. */
export const armTitle = (english: string): string =>
  english.replace(/^[a-z]+(?:-[a-z]+)?/i, (way) => ARMS[way.toLowerCase() as keyof typeof ARMS] ?? way);
