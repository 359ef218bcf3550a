import { plural, table } from '../table';

export const TEXTS = table('curve-section', {
  speedOverTime: 'Speed over time',
  points: (count: number) => plural(count, { one: `${count} point`, other: `${count} points` }),
  at: (time: string) => `at ${time}`,
  for: (time: string) => `, for ${time}`,
  kinds: { start: 'start', end: 'end', hold: 'hold', stop: 'stop' },
  drives: (speed: string) => `drives ${speed}`,
  point: 'Point',
  stop: 'Stop',
  via: 'Via',
  whereItStops: 'Where it stops',
  stops: (place: string | null) => `Stops ${place ?? 'here'}`,
  after: (way: string, lasts: string) => `after ${way}, for ${lasts}`,
});
