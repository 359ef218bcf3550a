import { table } from '../table';

export const TEXTS = table('pins', {
  pin: 'Pin this future',
  selectFirst: 'Select a road user with futures first.',
  atMost: (most: number) => `${most} futures are pinned, the maximum. Unpin one first.`,
  pinLetter: (letter: string) => `Pin future ${letter}`,
  unpinLetter: (letter: string) => `Unpin future ${letter}`,
  unpin: (name: string) => `Unpin future: ${name}`,
  pinnedSign: 'pinned',
  pinned: (letter: string, name: string) => `Future ${letter} of ${name} pinned`,
  unpinned: (future: string, name: string) => `Future of ${name} unpinned: ${future}`,
  taken: (future: string, name: string) => `Pinned future of ${name} chosen: ${future}`,
  anotherType: 'for another type',
  startsAway: (distance: string) => `starts ${distance} away`,
  startsTurned: 'starts with another heading',
  startsAt: (speed: string) => `starts at ${speed}`,
  fromTheGoal: (distance: string) => `${distance} from the goal`,
  endsTurned: 'ends with another heading',
  endsAt: (speed: string) => `ends at ${speed}`,
  missesVia: 'misses a via point',
  noLongerFits: (name: string, why: string) =>
    `${name} no longer fits: ${why}. Choosing this future restores its start and goal.`,
});
