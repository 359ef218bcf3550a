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
  /** A place along the lane: "100 m ahead", "5 m back"; separated by bars. */
  onward: 'ahead|on|forward',
  back: 'back|behind',
  laneEnds: (far: string) => `The lane ends after ${far}`,
  /** A gap that can be held: "12 m behind Car 1". */
  keep: (where: string) => `Keep ${where}`,
  relativeTo: (name: string) => `relative to ${name}`,
  relative: 'Relative',
  goalRelativeTo: 'Goal relative to another road user',
  example: (name: string) => `12 m ahead of ${name}, one lane left`,
  related: (name: string, words: string) => `Goal of ${name}: ${words}`,
  ended: (name: string) => `Goal of ${name} no longer relative`,
  end: 'Keep the position, end the relation',
  nameAnother: (name: string) => `Name another road user, as in: 12 m ahead of ${name}`,
  sayWhere: 'Give one distance or time: 12 m ahead, 8 m behind, 1.2 s behind, 0.5 s after',
  outsideOf: (least: string, most: string) => `${least} to ${most} is possible`,
  ring: (name: string) => `The goal of ${name} depends on this one`,
  row: (most: number) => `At most ${most} goals can depend on each other in a chain`,
  setPlace: 'Set a goal first: the place that both pass',
});
