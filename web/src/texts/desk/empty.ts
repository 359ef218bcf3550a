import { table } from '../table';

export const TEXTS = table('empty', {
  nobodyIsHere: 'Nobody is here yet',
  close: 'Close',
  theMapIsInNobody: 'The map is in. Nobody is on it yet.',
  plainGroundNobody: 'Plain ground, and nobody on it yet.',
  startWithOne: 'Start with one car, or with a whole rush hour. Everything can be undone.',
  insteadOfThis: 'instead of this one',
  forEverything: 'for everything else',
  newMap: 'New map',
  startWithACrossing: 'Start with a crossing',
  bringAScene: 'Bring a scene',
  dropSceneFiles: 'Drop scene files anywhere',
  scenarioRecords: 'Scenario records, lane maps or saved scenes · or ',
  theServerIsNot: 'The server is not answering. Scenes appear here when it does.',
  thereAreNoExamples: 'There are no examples here. Drop a scenario record or a saved scene.',
  openAnExample: 'Open an example and drag a car. Or bring your own scene.',
  startFromANewMap: 'start from a new map',
});
