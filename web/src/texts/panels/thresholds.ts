import { table } from '../table';

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
  timeMeans:
    'Those count that come nearer and would meet, were both to go on as they do. Who passes beside on a line of its own does not, nor do people on foot among each other.',
  resetAll: 'As usual again',
  reset: 'What counts is as usual again',
  gapNow: (value: number) => `Near misses count below ${value} m`,
  timeNow: (value: number) => `Near misses count below ${value} s`,
  brakingNow: (value: number) => `Braking counts above ${value} m/s²`,
  steeringNow: (value: number) => `Steering counts above ${value} m/s²`,
  countsBelow: (time: string, gap: string) =>
    `Counts as a near miss below ${time} or ${gap}, where both would meet if they went on.`,
});
