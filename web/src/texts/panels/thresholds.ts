import { table } from '../table';

export const TEXTS = table('thresholds', {
  actionLabel: 'Thresholds',
  reset: 'Thresholds reset to default',
  gapNow: (value: number) => `Near-miss gap set to ${value} m`,
  timeNow: (value: number) => `Near-miss TTC set to ${value} s`,
  brakingNow: (value: number) => `Hard braking set to ${value} m/s²`,
  steeringNow: (value: number) => `Hard steering set to ${value} m/s²`,
  nearMissBelow: (time: string, gap: string) =>
    `Near miss: TTC below ${time} or gap below ${gap}, on a collision course.`,
});
