import { table } from '../table';

export const TEXTS = table('empty', {
  noRoadUsersYet: 'No road users yet',
  close: 'Close',
  mapAdded: 'Map added. No road users yet.',
  emptyScene: 'Empty scene. No map, no road users yet.',
  placeOrFill: 'Place one car, or fill the map with traffic. Every step can be undone.',
  toStartOver: 'to start over',
  forAllActions: 'for all actions',
  newMap: 'New map',
  startWithACrossing: 'Start with a junction',
  importAScene: 'Import a scene',
  dropSceneFiles: 'Drop scene files anywhere',
  scenarioRecords: 'Scenario records, lane maps or saved scenes · or ',
  theServerIsNot: 'The server is not answering. Scenes appear here once it does.',
  noExamplesFound: 'No examples found. Drop a scenario record or a saved scene.',
  openAnExample: 'Open an example and drag a car, or import your own scene.',
  startFromANewMap: 'start from a new map',
});
