import { table } from '../table';

export const TEXTS = table('point-fields', {
  whyTheCurveCannot: 'Why the curve cannot be driven',
  cannotMakeIt: (time: string, by: string) => `Cannot make it by ${time} s: ${by} short.`,
  cannotReachBy: (wanted: string, by: string, reached: string) =>
    `Cannot reach ${wanted} by ${by}: ${reached} is the most by then.`,
  cannotBrakeTo: (wanted: string, by: string, reached: string) =>
    `Cannot brake to ${wanted} by ${by}: still ${reached} then.`,
  cannotStopBy: (by: string, reached: string) => `Cannot stop by ${by}: still ${reached} then.`,
  giveItSMore: (by: string) => `Give it ${by} s more`,
  shorterStopS: (hold: string) => `Shorter stop, ${hold} s`,
  leaveAt: (toIt: string) => `Leave at ${toIt}`,
  onlyDownTo: (toIt: string) => `Only down to ${toIt}`,
  onlyUpTo: (toIt: string) => `Only up to ${toIt}`,
  pointOfTheSpeed: 'Point of the speed curve',
  speedAtThisPoint: 'Speed at this point',
  for: 'for',
  secondsThatIt: 'Seconds that it is held',
  at: 'at',
  timeOfThisPoint: 'Time of this point',
  removeThisPoint: 'Remove this point',
  clearTheCurve: 'Clear the curve',
  brakesAtMost: (braking: string) => `brakes ${braking} at most`,
});
