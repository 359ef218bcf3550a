import { table } from '../table';

export const TEXTS = table('thresholds-section', {
  thresholds: 'Thresholds',
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
});
