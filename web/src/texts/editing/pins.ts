import { table } from '../table';

export const TEXTS = table('pins', {
  pin: 'Pin this future',
  selectFirst: 'Select a road user with futures first.',
  atMost: (most: number) => `${most} are pinned, as many as there can be. Let one go first.`,
  pinLetter: (letter: string) => `Pin future ${letter}`,
  letGoLetter: (letter: string) => `Let future ${letter} go`,
  letGo: (name: string) => `Let go of the pinned future: ${name}`,
  pinnedSign: 'pinned',
  pinned: (letter: string, name: string) => `Future ${letter} of ${name} pinned`,
  unpinned: (future: string, name: string) => `Pinned future of ${name} let go: ${future}`,
  taken: (future: string, name: string) => `Pinned future of ${name} chosen: ${future}`,
  anotherKind: 'for another kind',
  startsAway: (distance: string) => `starts ${distance} away`,
  startsTurned: 'starts turned otherwise',
  startsAt: (speed: string) => `starts at ${speed}`,
  fromTheGoal: (distance: string) => `${distance} from the goal`,
  endsTurned: 'ends turned otherwise',
  endsAt: (speed: string) => `ends at ${speed}`,
  missesVia: 'misses a via point',
  noLongerFits: (name: string, why: string) =>
    `${name}: ${why}, so it does not fit any more. Choosing it brings back its start and goal.`,
});
