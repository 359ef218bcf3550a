import { plural, table } from '../table';

export const TEXTS = table('generation', {
  generatorAway: 'The generator is not answering. Nothing is lost.',
  change: 'Change',
  undone: 'Undone',
  redone: 'Redone',
  backToTheBeginning: 'Back to the beginning',
  nowAt: (name: string) => `Now at: ${name}.`,
  restored: 'Restored.',
  selected: (name: string) => `${name} selected.`,
  roadUsersSelected: (count: number) => `${count} road users selected.`,
  sceneOpened: 'Scene opened',
  changesComputed: (waiting: number) =>
    plural(waiting, { one: ` ${waiting} change computed.`, other: ` ${waiting} changes computed.` }),
  theGenerator: (done: string) => `The generator is back.${done}`,
  waitingChanges: 'Waiting changes',
  thisTakesLonger: 'This is taking longer than usual.',
  sixFutures: (shown: string, rank: number) => `Six futures. Shown: ${shown}, rank ${rank}.`,
  aValueIsOutside: (min: string, max: string) => `A value is outside ${min} to ${max}.`,
  toS: (window: number, min: number) => `${window} to ${min} s`,
  keepCurve: 'Keep speed curve',
  curveIsOff: 'The speed curve no longer applies.',
  collisionWith: (other: string, time: string) => ` Collision with ${other} at ${time}.`,
  noOtherAffected: ' No other road user is affected.',
  othersChangedAndHit: (n: number, step: string, hit: string) =>
    plural(n, { one: `${step}. ${n} other changed.${hit}`, other: `${step}. ${n} others changed.${hit}` }),
  collisionAnd: (name: string, name2: string, time: string) => `Collision, ${name} and ${name2}, ${time} seconds.`,
  asBefore: 'as before',
  importDidNotLoad: 'The import did not load. Try again when the network is back.',
  theSearchDid: 'The search did not load. Try again when the network is back.',
});
