import { table } from './table';

export const TEXTS = table('thresholds', {
  whatCounts: 'What counts',
  whatCountsAsEvent: 'What counts as an event',
  asUsual: 'as usual',
  changedHere: 'changed in this scene',
  gap: 'Near miss, gap below',
  time: 'Near miss, time below',
  braking: 'Hard braking above',
  steering: 'Hard steering above',
  usually: (value: string) => `usually ${value}`,
  timeMeans: 'The time is that to a collision, were both to go on as they do.',
  resetAll: 'As usual again',
  reset: 'What counts is as usual again',
  gapNow: (value: number) => `Near misses count below ${value} m`,
  timeNow: (value: number) => `Near misses count below ${value} s`,
  brakingNow: (value: number) => `Braking counts above ${value} m/s²`,
  steeringNow: (value: number) => `Steering counts above ${value} m/s²`,
  countsBelow: (time: string, gap: string) => `Counts as a near miss below ${time} or ${gap}.`,
});
