import { table } from '../table';

export const TEXTS = table('point-fields', {
  whyTheCurveCannot: 'Why the curve is not drivable',
  cannotReachTheGoal: (time: string, by: string) => `Cannot reach the goal by ${time} s: ${by} short.`,
  cannotReachBy: (wanted: string, by: string, reached: string) =>
    `Cannot reach ${wanted} by ${by}: ${reached} at most.`,
  cannotBrakeTo: (wanted: string, by: string, reached: string) =>
    `Cannot brake to ${wanted} by ${by}: still at ${reached}.`,
  cannotStopBy: (by: string, reached: string) => `Cannot stop by ${by}: still at ${reached}.`,
  allowSMore: (by: string) => `Allow ${by} s more`,
  shorterStopS: (hold: string) => `Shorter stop, ${hold} s`,
  leaveAt: (toIt: string) => `Leave at ${toIt}`,
  onlyDownTo: (toIt: string) => `Only down to ${toIt}`,
  onlyUpTo: (toIt: string) => `Only up to ${toIt}`,
  pointOfTheSpeed: 'Point of the speed curve',
  speedAtThisPoint: 'Speed at this point',
  for: 'for',
  durationAtThisSpeed: 'Duration at this speed in seconds',
  at: 'at',
  timeOfThisPoint: 'Time of this point',
  removeThisPoint: 'Remove this point',
  clearTheCurve: 'Clear curve',
  brakesAtUpTo: (braking: string) => `brakes at up to ${braking}`,
});
