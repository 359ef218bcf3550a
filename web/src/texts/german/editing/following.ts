import type { TEXTS } from '../../editing/following';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  run: 'Lauf',
  drivenElsewhere: 'Dieser Lauf wird von einem anderen Programm gesteuert und ist hier schreibgeschützt.',
  makeACopy: 'Kopie anlegen',
  notThere: (why) => `Der Lauf kann nicht gezeigt werden. ${why}`,
  followed: 'Lauf',
  secondsOf: (names, time) => (names ? `Von außen gesteuert: ${names} · ${time} s` : `Lauf · ${time} s`),
  hasEnded: (time) => `Der Lauf ist zu Ende · ${time} s`,
};
