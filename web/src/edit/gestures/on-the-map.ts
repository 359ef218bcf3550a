// What a click on the map is on, in words: a signal, a crosswalk, a stop line, or a lane with its limit.
import { insidePolygon, pointAt, type Vec } from '../../model/base/geometry';
import { STEP_S } from '../../model/base/motion';
import { speedInUse } from '../../model/base/units';
import { nearestLanes, type Lane } from '../../model/document/lanemap';
import type { Scene, Signal } from '../../model/document/scene';
import { laneWords } from '../moves/snap';
import { TEXTS } from '../../texts/desk/gestures';

/** A stop line or a signal is clicked within this distance, metres. */
const NEAR_M = 2;
/** Half the width of the widest lane, metres. */
const BESIDE_M = 2.6;

/** Null beside all of it. */
export function wordsOnMap(scene: Scene, [x, y]: Vec, time: number): string | null {
  const { map } = scene;
  const lane = nearestLanes(map, x, y, null, BESIDE_M, (l) => l.kind === 'road' || l.kind === 'bike').at(0);
  const place = lane ? laneWords(map, { type: 'cyclist' }, lane.x, lane.y, lane.heading) : '';
  const signal = scene.signals.find((s) => near(stopOf(scene, s), x, y));
  if (signal) return TEXTS.signalAt(phaseWords(signal, time), place);
  if (map.stopSigns.some((at) => near(at, x, y))) return TEXTS.stopLine(place);
  if (map.crosswalks.some((p) => insidePolygon(x, y, p))) return TEXTS.crosswalk(scene.signals.length > 0);
  return lane ? laneSaid(lane.lane, place) : null;
}

const near = (at: Vec | null, x: number, y: number): boolean => !!at && Math.hypot(at[0] - x, at[1] - y) < NEAR_M;

function stopOf(scene: Scene, { lane: id, stop }: Signal): Vec | null {
  const lane = scene.map.lanes.get(id);
  if (stop || !lane) return stop;
  const start = pointAt(lane.line, 0);
  return [start.x, start.y];
}

/** `red until 4.2 s` */
function phaseWords({ states }: Signal, time: number): string {
  const step = Math.floor(time / STEP_S + 1e-6);
  const at = states.filter(([first]) => first <= step).at(-1)?.[1] ?? 'unknown';
  const colour = /stop/.test(at) ? 'red' : /caution/.test(at) ? 'amber' : /go/.test(at) ? 'green' : 'unknown';
  const next = states.find(([first, name]) => first > step && name !== at);
  return TEXTS.phases[colour] + (next ? TEXTS.until((next[0] * STEP_S).toFixed(1)) : '');
}

function laneSaid({ limit, type, kind }: Lane, place: string): string {
  const who = kind === 'bike' ? TEXTS.forCyclists : type === 'bus_lane' ? TEXTS.forBuses : null;
  const words = [
    place.charAt(0).toUpperCase() + place.slice(1),
    limit === null ? null : TEXTS.limit(speedInUse(limit, false)),
    who,
  ];
  return `${words.filter(Boolean).join(', ')}.`;
}
