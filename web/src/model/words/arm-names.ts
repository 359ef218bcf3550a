// Names of lanes at a junction: by arm and manoeuvre. Without a single junction, compass directions are used.
import { pointAt, type Vec } from '../base/geometry';
import { TEXTS } from '../../texts/scene/places';
import { turnOf, type Lane, type LaneMap } from '../document/lanemap';

/** Least angle of a turn, radians. */
const TURNS_RAD = 0.35;
/** Connectors within this distance belong to one junction, and its arms begin within it. */
const JUNCTION_M = 45;
/** The main junction has this share of all connectors: those into a car park do not count. */
const MOST = 0.6;
/** More connectors than any one junction has. */
const MANY = 400;
/** Lanes are seen from the junction at this distance, metres. */
const OUT_M = 20;
/** Lanes within this many steps of the junction are its arms. */
const FAR_LANES = 4;

const known = new WeakMap<LaneMap, { readonly centre: Vec | null; readonly names: Map<string, LaneName | null> }>();

/** A place by its name and with a preposition. */
export interface LaneName {
  /** `W arm, left-turn lane` or `off the lanes`. */
  readonly name: string;
  /** `on W arm, left-turn lane` or `off the lanes`. */
  readonly place: string;
}

export const namedLane = (name: string): LaneName => ({ name, place: TEXTS.on(name) });

/** Of a place whose words have a preposition. */
export const namedPlace = (name: string): LaneName => ({ name, place: name });

/** `W arm, left-turn lane`; null where compass directions are used. */
export function armLane(map: LaneMap, lane: Lane): LaneName | null {
  let of = known.get(map);
  if (!of) known.set(map, (of = { centre: mainJunction(map), names: new Map() }));
  if (!of.centre) return null;
  const name = of.names.get(lane.id);
  if (name !== undefined) return name;
  const words = lane.inside ? across(lane, of.centre) : named(map, lane, of.centre);
  const given = words === null ? null : lane.inside ? namedPlace(words) : namedLane(words);
  of.names.set(lane.id, given);
  return given;
}

const middle = (l: Lane): Vec => {
  const p = pointAt(l.line, l.line.length / 2);
  return [p.x, p.y];
};

const near = (p: Vec, q: Vec): boolean => Math.hypot(p[0] - q[0], p[1] - q[1]) < JUNCTION_M;

/** The centre of the junction with most connectors; null where there is none. */
function mainJunction(map: LaneMap): Vec | null {
  const all = [...map.lanes.values()].filter((l) => l.inside).map(middle);
  // A large map has more than one junction, and all pairs would take too long.
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

/** Connectors straight across are named like other lanes. */
function across(lane: Lane, junction: Vec): string | null {
  return near(middle(lane), junction) ? TEXTS.across[manner(lane)] : null;
}

function named(map: LaneMap, lane: Lane, junction: Vec): string | null {
  const outFrom = reach(map, lane, 'prev');
  const onTo = reach(map, lane, 'next');
  const away = outFrom.length && onTo.length ? leadsAway(lane, junction) : !onTo.length;
  const into = away ? [] : onTo;
  const ways = away ? outFrom : onTo;
  // A part of a ring belongs to no arm.
  if (away === null || !ways.length) return null;
  const centre = meanOf(ways.map(middle));
  if (!near(centre, junction)) return null;
  // A place a little outside the junction identifies the arm, however the road bends further out. At the far end an
  // outer lane of a wide road is beside the arm.
  const { length } = lane.line;
  const at = pointAt(lane.line, into.length ? Math.max(0, length - OUT_M) : Math.min(length, OUT_M));
  const arm = TEXTS.arm(compass(Math.atan2(at.y - junction[1], at.x - junction[0])));
  if (lane.kind === 'bike') return TEXTS.bikeLane(arm);
  if (lane.type === 'bus_lane') return TEXTS.busLane(arm);
  const turns = new Set(into.map(manner));
  // A way into a roundabout does not determine the exit.
  const after = into.flatMap((l) => l.next.flatMap((id) => map.lanes.get(id) ?? []));
  const leadsOut = after.every((l) => !l.inside && leadsAway(l, junction) !== null);
  const one = turns.size === 1 && leadsOut ? [...turns][0] : null;
  if (one === 'left') return TEXTS.leftTurnLane(arm);
  if (one === 'right') return TEXTS.rightTurnLane(arm);
  return into.length ? TEXTS.inboundLane(arm) : TEXTS.outboundLane(arm);
}

/** A lane leads round a place if its distance varies by less than this, metres. */
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

/** The connectors that a lane leads to, or comes from, over a few lanes. */
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

const COMPASS = [TEXTS.e, TEXTS.ne, TEXTS.n, TEXTS.nw, TEXTS.w, TEXTS.sw, TEXTS.s, TEXTS.se] as const;

function compass(angle: number): string {
  return COMPASS[((Math.round((angle * 4) / Math.PI) % 8) + 8) % 8];
}
