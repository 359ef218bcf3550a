import { table } from './table';

export const TEXTS = table('places', {
  across: {
    straight: 'in the crossing, straight on',
    left: 'in the crossing, turning left',
    right: 'in the crossing, turning right',
  },
  arm: (compass: string) => `${compass} arm`,
  bikeLane: (arm: string) => `${arm}, bike lane`,
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
