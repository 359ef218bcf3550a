import type { TEXTS } from '../../desk/scenes';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  today: (clock: string) => `heute ${clock}`,
  yesterday: (clock: string) => `gestern ${clock}`,
  scenes: 'Szenen',
  findAScene: 'Szene suchen',
  dropSceneFiles: 'Dateien hierher ziehen',
  chooseFiles: 'Dateien wählen',
  supportedFormats: 'unterstützte Formate',
  noSceneOfThat: 'Keine Szene mit diesem Namen.',
  loading: 'Lädt …',
  recent: 'Zuletzt',
  mine: 'Gesichert',
  examples: 'Beispiele',
  recorded: 'Aufgezeichnet',
  newName: 'Neuer Name',
  roadUsers: (n: number) => `${n} Teilnehmer`,
  noRoadUsers: 'leer',
  or: 'oder ',
  recordedWithin: 'aufgezeichnet',
  example: 'Beispiel',
  own: 'eigene',
};
