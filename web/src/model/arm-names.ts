// What a lane is called at a junction: by its arm, and by what it does there. Where there is no junction, or more than
// one, compass words say more.
import { pointAt, type Vec } from './geometry';
import { TEXTS } from '../texts/places';
import { turnOf, type Lane, type LaneMap } from './lanemap';

/** A turn is one from here on, radians. */
const TURNS_RAD = 0.35;
/** Ways across that lie within so many metres of each other are of one junction. */
const JUNCTION_M = 70;
/** Lanes so many before or after the junction are its arms. */
const FAR_LANES = 4;

const known = new WeakMap<LaneMap, { readonly one: boolean; readonly names: Map<string, string | null> }>();

/** `W arm, left-turn lane`; null where compass words say more. */
export function armWords(map: LaneMap, lane: Lane): string | null {
  let of = known.get(map);
  if (!of) known.set(map, (of = { one: isOneJunction(map), names: new Map() }));
  if (!of.one) return null;
  const name = of.names.get(lane.id);
  if (name !== undefined) return name;
  const words = lane.inside ? across(lane) : named(map, lane);
  of.names.set(lane.id, words);
  return words;
}

const middle = (l: Lane): Vec => {
  const p = pointAt(l.line, l.line.length / 2);
  return [p.x, p.y];
};

function isOneJunction(map: LaneMap): boolean {
  const all = [...map.lanes.values()].filter((l) => l.inside).map(middle);
  if (!all.length) return false;
  const span = (k: 0 | 1): number => Math.max(...all.map((p) => p[k])) - Math.min(...all.map((p) => p[k]));
  return Math.max(span(0), span(1)) < JUNCTION_M;
}

const manner = (l: Lane): 'left' | 'right' | 'straight' => {
  const turn = turnOf(l.line);
  return turn > TURNS_RAD ? 'left' : turn < -TURNS_RAD ? 'right' : 'straight';
};

/** Those on the crossing that go straight on are lanes like others. */
function across(lane: Lane): string | null {
  return TEXTS.across[manner(lane)];
}

function named(map: LaneMap, lane: Lane): string | null {
  const into = reach(map, lane, 'next');
  const outOf = into.length ? [] : reach(map, lane, 'prev');
  const ways = into.length ? into : outOf;
  if (!ways.length) return null;
  const all = ways.map(middle);
  const centre: Vec = [mean(all.map((p) => p[0])), mean(all.map((p) => p[1]))];
  // Seen from the junction the end that is at it says which arm it is, however the road bends further out.
  const at = pointAt(lane.line, into.length ? lane.line.length : 0);
  const arm = TEXTS.arm(compass(Math.atan2(at.y - centre[1], at.x - centre[0])));
  if (lane.kind === 'bike') return TEXTS.bikeLane(arm);
  if (lane.type === 'bus_lane') return TEXTS.busLane(arm);
  const turns = new Set(into.map(manner));
  const one = turns.size === 1 ? [...turns][0] : null;
  if (one === 'left') return TEXTS.leftTurnLane(arm);
  if (one === 'right') return TEXTS.rightTurnLane(arm);
  return into.length ? TEXTS.inboundLane(arm) : TEXTS.outboundLane(arm);
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

function compass(angle: number): string {
  const names = ['E', 'NE', 'N', 'NW', 'W', 'SW', 'S', 'SE'];
  return names[((Math.round((angle * 4) / Math.PI) % 8) + 8) % 8];
}
