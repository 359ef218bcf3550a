import { plural, table } from '../table';

export const TEXTS = table('map-making', {
  theServerIsNot: 'The server is not answering.',
  mapClosed: 'Map closed.',
  keepEditing: 'Keep editing',
  noLongerOnALane: (count: number, lost: string) =>
    plural(count, {
      one: `${count} road user is no longer on a lane: ${lost}.`,
      other: `${count} road users are no longer on a lane: ${lost}.`,
    }),
  otherMap: (base: undefined | string) => `${base}, other map`,
  theHandlesOf: 'The map handles did not load. Open the map again when the network is back.',
});
