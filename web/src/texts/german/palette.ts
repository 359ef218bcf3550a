import type { TEXTS } from '../palette';
import type { Said } from '../table';

export const german: Said<typeof TEXTS> = {
  scenes: 'Szenen',
  for: (name: string) => `Für ${name}`,
  roadUsers: 'Verkehrsteilnehmer',
  find: (sentenceOf) => `Suchen: ${sentenceOf}`,
  triesSpeedsGoal: 'probiert Tempo, Zielzeit und Startwert',
  goToS: (time: string) => `Zu ${time} s`,
  playhead: 'Abspielmarke',
  actions: 'Aktionen',
  doAnything: 'Was soll geschehen?',
  findAnAction: 'Aktion suchen',
  esc: 'Esc',
  nothingOfThat: 'Nichts mit diesem Namen',
  choose: 'wählen',
  doIt: 'ausführen',
  typeANumberTo: 'Eine Nummer findet jemanden, eine Zeit wie 4,2 springt dorthin',
  askedForNear: 'beinahe knapp nah',
  askedForCollision: 'zusammensto unfall crash trifft',
  askedForFirst: 'zuerst vor',
  askedForBraking: 'brems',
  askedForGoal: 'ziel ankunft',
  askedForRed: 'rot ampel',
  parked: 'parkt',
};
