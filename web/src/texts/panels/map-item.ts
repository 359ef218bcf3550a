import { plural, table } from '../table';

export const TEXTS = table('map-item', {
  kinds: { signal: 'Signal', 'stop-sign': 'Stop sign', crosswalk: 'Crosswalk', lane: 'Lane' },
  lights: { stop: 'Red', caution: 'Amber', go: 'Green', unknown: 'Unknown' },
  phases: 'Phases',
  group: (n: number) => plural(n, { one: '1 lane', other: `${n} lanes` }),
  phasesOfTheSignal: 'Phases of the signal',
  from: (time: string) => `from ${time} s`,
  /** Begin of a phase; `light` is its name. */
  beginOf: (light: string) => `${light} from`,
  edge: (before: string, after: string) => `${before} to ${after}`,
  atTime: (time: string) => `at ${time} s`,
  remove: (light: string) => `Remove: ${light}`,
  add: (light: string, time: string) => `${light} from ${time} s`,
  howToAdd: 'Drag the edges on the timeline; double-click there to add one.',
  close: 'Close',
  speedLimit: 'Speed limit',
  notGiven: 'not given',
  whoMayUseIt: 'Who may use it',
  users: {
    motor: 'Motor vehicles and cyclists',
    motorAlone: 'Motor vehicles',
    bus: 'Buses and cyclists',
    bike: 'Cyclists',
  },
  inTheMap: (rule: string) => `In the map: ${rule}`,
  limitChanged: (place: string) => `Speed limit changed: ${place}`,
  usersChanged: (place: string) => `Lane use changed: ${place}`,
  priority: 'Priority',
  pedestriansFirst: 'Pedestrians have priority; vehicles and cyclists yield',
  bySignals: 'By the signals; turning vehicles yield to pedestrians',
  everyoneStops: 'All stop here, then yield to traffic on the other road',
});
