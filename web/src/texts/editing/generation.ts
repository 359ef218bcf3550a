import { plural, table } from '../table';

export const TEXTS = table('generation', {
  generatorAway: 'Generator away. Nothing is lost.',
  change: 'Change',
  undone: 'Undone',
  doneAgain: 'Done again',
  backToTheBeginning: 'Back to the beginning',
  nowAt: (name: string) => `Now at: ${name}.`,
  putBack: 'Put back.',
  selected: (name: string) => `${name} selected.`,
  roadUsersSelected: (count: number) => `${count} road users selected.`,
  sceneOpened: 'Scene opened',
  changesWorked: (waiting: number) =>
    plural(waiting, { one: ` ${waiting} change worked out.`, other: ` ${waiting} changes worked out.` }),
  theGenerator: (done: string) => `The generator is back.${done}`,
  waitingChanges: 'Waiting changes',
  thisTakesLonger: 'This takes longer than usual.',
  sixFuturesMost: (best: string, likely: number) => `Six futures. Most likely: ${best}, ${likely} percent.`,
  aValueIsOutside: (min: string, max: string) => `A value is outside ${min} to ${max}.`,
  toS: (window: number, min: number) => `${window} to ${min} s`,
  keepItsCurve: 'Keep its speed curve',
  itsCurveIsOff: 'Its speed curve is off.',
  itHitsAt: (other: string, time: string) => ` It hits ${other} at ${time}.`,
  othersChanged: (n: number, step: string) =>
    plural(n, { one: `${step}. ${n} other changed.`, other: `${step}. ${n} others changed.` }),
  nobodyElseHad: ' Nobody else had to change.',
  othersChangedAndHit: (n: number, step: string, hit: string) =>
    plural(n, { one: `${step}. ${n} other changed.${hit}`, other: `${step}. ${n} others changed.${hit}` }),
  collisionAnd: (name: string, name2: string, time: string) => `Collision, ${name} and ${name2}, ${time} seconds.`,
  asBefore: 'as before',
  theSearchDid: 'The search did not load. Try again when the network is back.',
});
