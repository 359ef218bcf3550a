import type { TEXTS } from '../../desk/parts';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  noSeed: (typed) => `„${typed}“ ist kein Startwert: eine ganze Zahl eingeben.`,
  seed: 'Startwert',
  diversity: 'Vielfalt',
  length: 'Dauer',
  computedLength: 'Berechnete Dauer',
  replanEvery: 'Neu planen alle',
  planningWindow: 'Planungsfenster aller Verkehrsteilnehmer',
  resultCode: 'Ergebniscode',
  howFarTheSix: 'Wie verschieden die sechs Zukünfte sein dürfen',
  react: 'Reagieren',
  replayLog: 'Aufzeichnung',
  continueAsNow: 'Weiter',
  holdStill: 'Stehen',
  allReactOnRelease: 'Alle reagieren beim Loslassen; gesetzte Ziele werden weiterhin erreicht.',
  recordedReplay: 'Aufgezeichnete folgen der Aufzeichnung; eingesetzte bewegen sich unverändert weiter.',
  othersHoldStill: 'Andere bleiben am Start stehen; niemand kommt hinzu.',
};
