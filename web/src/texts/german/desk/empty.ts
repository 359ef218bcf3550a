import type { TEXTS } from '../../desk/empty';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  nobodyIsHere: 'Noch ist niemand hier',
  close: 'Schließen',
  theMapIsInNobody: 'Die Karte ist da. Noch ist niemand darauf.',
  plainGroundNobody: 'Freie Fläche, und noch niemand darauf.',
  startWithOne: 'Mit einem Auto beginnen oder mit einer ganzen Stoßzeit. Alles lässt sich rückgängig machen.',
  insteadOfThis: 'statt dieser',
  forEverything: 'für alles andere',
  newMap: 'Neue Karte',
  startWithACrossing: 'Mit einer Kreuzung beginnen',
  bringAScene: 'Eine Szene mitbringen',
  dropSceneFiles: 'Dateien irgendwohin ziehen',
  scenarioRecords: 'Szenarien, Karten oder gesicherte Szenen · oder ',
  theServerIsNot: 'Der Server antwortet nicht. Sobald er es tut, stehen hier Szenen.',
  thereAreNoExamples: 'Hier gibt es keine Beispiele. Ein Szenario oder eine gesicherte Szene hierher ziehen.',
  openAnExample: 'Ein Beispiel öffnen und ein Auto ziehen. Oder eine eigene Szene mitbringen.',
  startFromANewMap: 'mit einer neuen Karte beginnen',
};
