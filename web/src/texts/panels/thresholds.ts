import { table } from '../table';

export const TEXTS = table('thresholds', {
  thresholds: 'Thresholds',
  actionLabel: 'Thresholds',
  isDefault: 'default',
  changedHere: 'changed in this scene',
  gap: 'Near miss: gap below',
  time: 'Near miss: TTC below',
  braking: 'Hard braking above',
  steering: 'Hard steering above',
  defaultIs: (value: string) => `default ${value}`,
  whatANearMissIs:
    'A near miss needs two road users that approach each other and would collide at constant speed and turn rate. Two pedestrians never count.',
  resetToDefault: 'Reset to default',
  reset: 'Thresholds reset to default',
  gapNow: (value: number) => `Near-miss gap set to ${value} m`,
  timeNow: (value: number) => `Near-miss TTC set to ${value} s`,
  brakingNow: (value: number) => `Hard braking set to ${value} m/s²`,
  steeringNow: (value: number) => `Hard steering set to ${value} m/s²`,
  nearMissBelow: (time: string, gap: string) =>
    `Near miss: TTC below ${time} or gap below ${gap}, on a collision course.`,
});
