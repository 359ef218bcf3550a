import type { TEXTS } from '../../desk/empty';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  nobodyIsHere: 'Noch keine Verkehrsteilnehmer',
  close: 'Schließen',
  theMapIsInNobody: 'Karte hinzugefügt. Noch keine Verkehrsteilnehmer.',
  plainGroundNobody: 'Leere Szene. Noch keine Karte, keine Verkehrsteilnehmer.',
  startWithOne: 'Einen Pkw einsetzen oder die Karte mit Verkehr füllen. Jeder Schritt lässt sich rückgängig machen.',
  insteadOfThis: 'um neu zu beginnen',
  forEverything: 'für alle Aktionen',
  newMap: 'Neue Karte',
  startWithACrossing: 'Mit einer Kreuzung beginnen',
  bringAScene: 'Eine Szene importieren',
  dropSceneFiles: 'Dateien auf die Seite ziehen',
  scenarioRecords: 'Szenarien, Karten oder gesicherte Szenen · oder ',
  theServerIsNot: 'Der Server antwortet nicht. Sobald er antwortet, stehen hier Szenen.',
  thereAreNoExamples: 'Keine Beispiele gefunden. Ein Szenario oder eine gesicherte Szene hierher ziehen.',
  openAnExample: 'Ein Beispiel öffnen und einen Pkw ziehen, oder eine eigene Szene importieren.',
  startFromANewMap: 'mit einer neuen Karte beginnen',
};
