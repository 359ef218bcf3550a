import { plural, table } from '../table';

export const TEXTS = table('curve-section', {
  speedOverTime: 'Speed over time',
  points: (count: number) => plural(count, { one: `${count} point`, other: `${count} points` }),
  at: (time: string) => `at ${time}`,
  for: (time: string) => `, for ${time}`,
  kinds: { start: 'start', end: 'end', hold: 'hold', stop: 'stop' },
  actual: (speed: string) => `actual ${speed}`,
  point: 'Point',
  stop: 'Stop',
  via: 'Via',
  stopsTitle: 'Stops',
  stops: (place: string | null) => `Stops ${place ?? 'here'}`,
  after: (way: string, lasts: string) => `after ${way}, for ${lasts}`,
});
