import type { TEXTS } from '../reading';
import type { Said } from '../table';

export const german: Said<typeof TEXTS> = {
  aColumnIsBroken: 'eine Spalte ist defekt',
  thisIsNotAScene: 'Das ist keine Szene: es fehlt die Liste der Verkehrsteilnehmer.',
  thisSceneWas: (version) => `Diese Szene wurde mit einer neueren Version (${version}) gesichert. Lesbar ist bis 1.`,
  theMapOfThis: 'Die Karte dieser Szene ist nicht hier.',
  untitled: 'Ohne Titel',
};
