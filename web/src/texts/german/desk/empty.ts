import type { TEXTS } from '../../desk/empty';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  noRoadUsersYet: 'Noch keine Verkehrsteilnehmer',
  close: 'Schließen',
  mapAdded: 'Karte hinzugefügt. Noch keine Verkehrsteilnehmer.',
  emptyScene: 'Leere Szene. Noch keine Karte, keine Verkehrsteilnehmer.',
  placeOrFill: 'Einen Pkw einsetzen oder die Karte mit Verkehr füllen. Jeder Schritt lässt sich rückgängig machen.',
  toStartOver: 'um neu zu beginnen',
  forAllActions: 'für alle Aktionen',
  newMap: 'Neue Karte',
  startWithACrossing: 'Mit einer Kreuzung beginnen',
  importAScene: 'Eine Szene importieren',
  dropSceneFiles: 'Dateien auf die Seite ziehen',
  scenarioRecords: 'Szenarien, Karten oder gesicherte Szenen · oder ',
  theServerIsNot: 'Der Server antwortet nicht. Sobald er antwortet, stehen hier Szenen.',
  noExamplesFound: 'Keine Beispiele gefunden. Ein Szenario oder eine gesicherte Szene hierher ziehen.',
  openAnExample: 'Ein Beispiel öffnen und einen Pkw ziehen, oder eine eigene Szene importieren.',
  startFromANewMap: 'mit einer neuen Karte beginnen',
};
