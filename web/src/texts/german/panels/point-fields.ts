import type { TEXTS } from '../../panels/point-fields';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  whyTheCurveCannot: 'Warum die Kurve nicht fahrbar ist',
  cannotMakeIt: (time, by) => `Bis ${time} s nicht zu schaffen: es fehlen ${by}.`,
  cannotReachBy: (wanted, by, reached) => `${wanted} sind bis ${by} nicht erreichbar: höchstens ${reached}.`,
  cannotBrakeTo: (wanted, by, reached) => `Bremsen auf ${wanted} geht bis ${by} nicht: dann noch ${reached}.`,
  cannotStopBy: (by, reached) => `Anhalten geht bis ${by} nicht: dann noch ${reached}.`,
  giveItSMore: (by) => `${by} s mehr geben`,
  shorterStopS: (hold) => `Kürzer halten, ${hold} s`,
  leaveAt: (toIt) => `Mit ${toIt} weiter`,
  onlyDownTo: (toIt) => `Nur bis auf ${toIt}`,
  onlyUpTo: (toIt) => `Nur bis ${toIt}`,
  pointOfTheSpeed: 'Punkt der Tempokurve',
  speedAtThisPoint: 'Tempo an diesem Punkt',
  for: 'für',
  secondsThatIt: 'Sekunden, die es gehalten wird',
  at: 'bei',
  timeOfThisPoint: 'Zeit dieses Punkts',
  removeThisPoint: 'Diesen Punkt entfernen',
  clearTheCurve: 'Kurve entfernen',
  brakesAtMost: (braking) => `bremst mit höchstens ${braking}`,
};
