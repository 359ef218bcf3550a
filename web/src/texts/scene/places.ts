import { table } from '../table';

export const TEXTS = table('places', {
  across: {
    straight: 'in the junction, straight on',
    left: 'in the junction, turning left',
    right: 'in the junction, turning right',
  },
  /** Compass directions in one or two letters. */
  e: 'E',
  ne: 'NE',
  n: 'N',
  nw: 'NW',
  w: 'W',
  sw: 'SW',
  s: 'S',
  se: 'SE',
  /** Arms by compass direction, without "arm". */
  arms: {
    east: 'East',
    northEast: 'North-east',
    north: 'North',
    northWest: 'North-west',
    west: 'West',
    southWest: 'South-west',
    south: 'South',
    southEast: 'South-east',
  },
  /** Of a lane; places beside the lanes have their own preposition: `off the lanes`. */
  on: (lane: string) => `on ${lane}`,
  arm: (compass: string) => `${compass} arm`,
  bikeLane: (arm: string) => `${arm}, cycle lane`,
  busLane: (arm: string) => `${arm}, bus lane`,
  leftTurnLane: (arm: string) => `${arm}, left-turn lane`,
  rightTurnLane: (arm: string) => `${arm}, right-turn lane`,
  inboundLane: (arm: string) => `${arm}, inbound lane`,
  outboundLane: (arm: string) => `${arm}, outbound lane`,
  atTheStopLine: 'at the stop line',
  beforeTheCrosswalk: 'before the crosswalk',
  behind: (name: string) => `behind ${name}`,
  per100MOfLane: (density: string) => `${density} per 100 m of lane`,
  per1000FtOfLane: (density: string) => `${density} per 1000 ft of lane`,
  metres: 'metres',
  feet: 'feet',
  aboutMinLeft: (minutes: string) => `about ${minutes} min left`,
  aboutSLeft: (seconds: string) => `about ${seconds} s left`,
});
