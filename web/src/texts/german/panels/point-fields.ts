import type { TEXTS } from '../../panels/point-fields';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  whyTheCurveCannot: 'Warum die Kurve nicht fahrbar ist',
  cannotReachTheGoal: (time, by) => `Ziel bis ${time} s nicht erreichbar: es fehlen ${by}.`,
  cannotReachBy: (wanted, by, reached) => `${wanted} sind bis ${by} nicht erreichbar: höchstens ${reached}.`,
  cannotBrakeTo: (wanted, by, reached) => `Bremsen auf ${wanted} bis ${by} nicht möglich: dann noch ${reached}.`,
  cannotStopBy: (by, reached) => `Anhalten bis ${by} nicht möglich: dann noch ${reached}.`,
  allowSMore: (by) => `${by} s mehr Zeit`,
  shorterStopS: (hold) => `Kürzer halten, ${hold} s`,
  leaveAt: (toIt) => `Mit ${toIt} weiter`,
  onlyDownTo: (toIt) => `Nur bis auf ${toIt}`,
  onlyUpTo: (toIt) => `Nur bis ${toIt}`,
  pointOfTheSpeed: 'Punkt der Tempokurve',
  speedAtThisPoint: 'Tempo an diesem Punkt',
  for: 'für',
  durationAtThisSpeed: 'Dauer mit diesem Tempo in Sekunden',
  at: 'bei',
  timeOfThisPoint: 'Zeit dieses Punkts',
  removeThisPoint: 'Diesen Punkt entfernen',
  clearTheCurve: 'Kurve entfernen',
  brakesAtUpTo: (braking) => `bremst mit bis zu ${braking}`,
};
