// What a click on the map is on, and in words: a signal, a crosswalk, a stop line, or a lane with its limit.
import { insidePolygon, pointAt, type Vec } from '../../model/base/geometry';
import { speedInUse } from '../../model/base/units';
import { nearestLanes, type Lane } from '../../model/document/lanemap';
import type { Scene, Signal } from '../../model/document/scene';
import { changesAt, hasSignals, lightAt, stopOf } from '../../model/physics/signals';
import { laneWords } from '../moves/snap';
import type { MapItem } from '../session/map-item';
import { capitalised } from '../../texts/language';
import { TEXTS } from '../../texts/desk/gestures';

/** A stop line or a signal is clicked within this distance, metres; on a crosswalk it has to be nearer. */
const NEAR_M = 2;
const NEAR_ON_CROSSWALK_M = 1;
/** Colours of lights, in the words of the texts. */
const COLOURS = { stop: 'red', caution: 'amber', go: 'green', unknown: 'unknown' } as const;
/** Half the width of the widest lane, metres. */
const BESIDE_M = 2.6;

const laneAt = ({ map }: Scene, [x, y]: Vec) =>
  nearestLanes(map, x, y, null, BESIDE_M, (l) => l.kind === 'road' || l.kind === 'bike').at(0);

/** Distance of the nearest signal, metres. */
export const signalAway = (scene: Scene, at: Vec): number => {
  const s = nearestSignal(scene, at, Infinity);
  return away(s && stopOf(s, scene.map.lanes.get(s.lane)), at);
};

/** Null beside all of it. A finger takes a signal within `finger` metres, too. */
export function itemOnMap(scene: Scene, at: Vec, finger = 0): MapItem | null {
  const { map } = scene;
  const [x, y] = at;
  const index = map.crosswalks.findIndex((p) => insidePolygon(x, y, p));
  const reach = Math.max(finger, index < 0 ? NEAR_M : NEAR_ON_CROSSWALK_M);
  const signal = nearestSignal(scene, at, reach);
  if (signal) return { kind: 'signal', lane: signal.lane, at: stopOf(signal, map.lanes.get(signal.lane))! };
  const sign = map.stopSigns.find((place) => away(place, at) < reach);
  if (sign) return { kind: 'stop-sign', at: sign };
  if (index >= 0) return { kind: 'crosswalk', index };
  const lane = laneAt(scene, at)?.lane;
  return lane ? { kind: 'lane', lane: lane.id, at } : null;
}

function nearestSignal({ map, signals }: Scene, at: Vec, reach: number): Signal | null {
  let best: Signal | null = null;
  let least = reach;
  for (const s of signals) {
    const d = away(stopOf(s, map.lanes.get(s.lane)), at);
    if (d >= least) continue;
    least = d;
    best = s;
  }
  return best;
}

const away = (place: Vec | null, [x, y]: Vec): number => (place ? Math.hypot(place[0] - x, place[1] - y) : Infinity);

/** Name of the place of an item: "E arm, inbound lane"; empty without a lane there. */
export function placeOfItem(scene: Scene, item: MapItem): string {
  if (item.kind === 'crosswalk') return '';
  // A signal belongs to the lane that leads to it, not to its turns.
  const { lanes } = scene.map;
  const before = item.kind === 'signal' ? lanes.get(lanes.get(item.lane)?.prev[0] ?? '') : undefined;
  const lane = before ? pointAt(before.line, before.line.length) : laneAt(scene, item.at);
  return lane ? laneWords(scene.map, { type: 'cyclist' }, lane.x, lane.y, lane.heading) : '';
}

export function itemWords(scene: Scene, item: MapItem, time: number): string {
  const place = placeOfItem(scene, item);
  switch (item.kind) {
    case 'signal':
      return TEXTS.signalAt(
        phaseWords(
          scene.signals.find((s) => s.lane === item.lane)!,
          time,
        ),
        place,
      );
    case 'stop-sign':
      return TEXTS.stopLine(place);
    case 'crosswalk':
      return TEXTS.crosswalk(hasSignals(scene, item.index));
    case 'lane':
      return laneSaid(scene.map.lanes.get(item.lane)!, place);
  }
}

/** `red until 4.2 s` */
function phaseWords(signal: Signal, time: number): string {
  const until = changesAt(signal, time);
  return TEXTS.phases[COLOURS[lightAt(signal, time)]] + (until === null ? '' : TEXTS.until(until.toFixed(1)));
}

function laneSaid({ limit, type, kind }: Lane, place: string): string {
  const who = kind === 'bike' ? TEXTS.forCyclists : type === 'bus_lane' ? TEXTS.forBuses : null;
  const words = [capitalised(place), limit === null ? null : TEXTS.limit(speedInUse(limit, false)), who];
  return `${words.filter(Boolean).join(', ')}.`;
}
