import type { TEXTS } from '../../panels/curve-section';
import { plural } from '../plural';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  speedOverTime: 'Tempo über der Zeit',
  points: (count) => plural(count, { one: `${count} Punkt`, other: `${count} Punkte` }),
  at: (time) => `bei ${time}`,
  for: (time) => `, ${time} lang`,
  kinds: { start: 'Start', end: 'Ende', hold: 'Konstant', stop: 'Halt' },
  actual: (speed: string) => `Ist: ${speed}`,
  point: 'Punkt',
  stop: 'Halt',
  via: 'Zwischenpunkt',
  stopsTitle: 'Halte',
  stops: (place) => `Hält ${place ?? 'hier'}`,
  after: (way, lasts) => `nach ${way}, ${lasts} lang`,
};
