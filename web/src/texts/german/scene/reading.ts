import type { TEXTS } from '../../scene/reading';
import type { Said } from '../../table';

const EXAMPLES: Readonly<Record<string, string>> = {
  'demo-crossing': 'Rosastr., Ecke 5. Str.',
  'demo-roundabout': 'Kreisverkehr, 4 Arme',
  'demo-residential': 'Schulstraße',
  'demo-arterial': 'Marktstraße am Abend',
  'demo-motorway': 'Einfahrt auf den Ring',
};

export const german: Said<typeof TEXTS> = {
  aColumnIsBroken: 'eine Spalte ist ungültig',
  thisIsNotAScene: 'Das ist keine Szene: es fehlt die Liste der Verkehrsteilnehmer.',
  thisSceneWas: (version) =>
    `Diese Szene wurde mit einer neueren Version (${version}) gesichert. Lesbar sind Versionen bis 1.`,
  theMapOfThis: 'Die Karte dieser Szene fehlt.',
  untitled: 'Ohne Titel',
  sceneName: (id: string, name: string) => EXAMPLES[id] ?? name,
};
