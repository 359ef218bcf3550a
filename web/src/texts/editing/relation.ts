import { plural, table } from '../table';

export const TEXTS = table('relation', {
  ahead: (gap: string, name: string) => `${gap} ahead of ${name}`,
  behind: (gap: string, name: string) => `${gap} behind ${name}`,
  after: (time: string, name: string) => `${time} after ${name}`,
  before: (time: string, name: string) => `${time} before ${name}`,
  at: (time: string) => ` at ${time}`,
  slower: (speed: string) => `, ${speed} slower`,
  faster: (speed: string) => `, ${speed} faster`,
  lanesLeft: (n: number, figure: string) =>
    plural(n, { one: `, ${figure} lane left`, other: `, ${figure} lanes left` }),
  lanesRight: (n: number, figure: string) =>
    plural(n, { one: `, ${figure} lane right`, other: `, ${figure} lanes right` }),
  /** Words of a typed relation, separated by bars. */
  words: {
    ahead: 'ahead|before',
    behind: 'behind',
    after: 'after',
    before: 'before',
    at: 'at',
    slower: 'slower',
    faster: 'faster',
    left: 'left',
    right: 'right',
    one: 'one|a',
    two: 'two',
    three: 'three',
    four: 'four',
  },
  /** A gap that can be held: "12 m behind Car 1". */
  keep: (where: string) => `Keep ${where}`,
  relativeTo: (name: string) => `relative to ${name}`,
  relative: 'Relative',
  goalRelativeTo: 'Goal relative to another road user',
  example: '12 m ahead of Car 1, one lane left',
  related: (name: string, words: string) => `Goal of ${name}: ${words}`,
  ended: (name: string) => `Goal of ${name} no longer relative`,
  end: 'Keep the place, end the relation',
  nameAnother: 'Name another road user of the scene, as in: 12 m ahead of Car 1',
  sayWhere: 'Give one distance or time: 12 m ahead, 8 m behind, 1.2 s behind, 0.5 s after',
  outsideOf: (least: string, most: string) => `${least} to ${most} is possible`,
  ring: (name: string) => `The goal of ${name} depends on this one`,
  row: (most: number) => `At most ${most} goals in a row can be relative to each other`,
  setPlace: 'Set a goal first: it is the place that both pass',
});
