// What a click on the map is on, in words: a signal, a crosswalk, a stop line, or a lane with its limit.
import { insidePolygon, type Vec } from '../../model/base/geometry';
import { speedInUse } from '../../model/base/units';
import { nearestLanes, type Lane } from '../../model/document/lanemap';
import type { Scene, Signal } from '../../model/document/scene';
import { changesAt, lightAt, stopOf } from '../../model/physics/signals';
import { laneWords } from '../moves/snap';
import { capitalised } from '../../texts/language';
import { TEXTS } from '../../texts/desk/gestures';

/** A stop line or a signal is clicked within this distance, metres. */
const NEAR_M = 2;
/** Colours of lights, in the words of the texts. */
const COLOURS = { stop: 'red', caution: 'amber', go: 'green', unknown: 'unknown' } as const;
/** Half the width of the widest lane, metres. */
const BESIDE_M = 2.6;

/** Null beside all of it. */
export function wordsOnMap(scene: Scene, [x, y]: Vec, time: number): string | null {
  const { map } = scene;
  const lane = nearestLanes(map, x, y, null, BESIDE_M, (l) => l.kind === 'road' || l.kind === 'bike').at(0);
  const place = lane ? laneWords(map, { type: 'cyclist' }, lane.x, lane.y, lane.heading) : '';
  const signal = scene.signals.find((s) => near(stopOf(s, map.lanes.get(s.lane)), x, y));
  if (signal) return TEXTS.signalAt(phaseWords(signal, time), place);
  if (map.stopSigns.some((at) => near(at, x, y))) return TEXTS.stopLine(place);
  if (map.crosswalks.some((p) => insidePolygon(x, y, p))) return TEXTS.crosswalk(scene.signals.length > 0);
  return lane ? laneSaid(lane.lane, place) : null;
}

const near = (at: Vec | null, x: number, y: number): boolean => !!at && Math.hypot(at[0] - x, at[1] - y) < NEAR_M;

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
