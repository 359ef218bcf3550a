// Move: the start or the goal of the selected road user, by keys.
import type { Agent } from '../model/scene';
import type { Command } from '../model/commands';
import type { Editor, Part } from '../edit/editor';
import { freeOnes } from '../edit/copying';
import * as moves from '../edit/moves';
import * as several from '../edit/several';
import { rad } from '../model/geometry';
import { placedBy } from './place';
import { activePart, hasAgent, hasFree, hasSomeFree, inGroup, type Action } from './action';

type Move = (e: Editor, a: Agent, part: Part) => Command | null;
/** The same for several; a way of moving that has none is for one alone. */
type MoveAll = (all: readonly Agent[]) => Command | null;
/** The same for who is about to be placed; false where nobody is. */
type MoveGhost = (e: Editor) => boolean;

interface Also {
  readonly icon?: string;
  readonly all?: MoveAll;
  readonly ghost?: MoveGhost;
}

const move = (
  id: string,
  label: string,
  key: string,
  help: string,
  make: Move,
  { icon, all, ghost }: Also = {},
): Omit<Action, 'group'> => ({
  id,
  label,
  keys: [key],
  help,
  icon,
  when: (c) => {
    if (ghost && placedBy(c)) return true;
    return all && c.editor.selected.value.length > 1 ? hasSomeFree(c) : hasFree(c);
  },
  run(c) {
    const { editor } = c;
    if (ghost && placedBy(c)) {
      ghost(editor);
      return;
    }
    const many = all && editor.selected.peek().length > 1;
    const free = many ? freeOnes(editor) : [];
    const a = editor.agent.peek();
    const command = many ? free.length && all(free) : a && make(editor, a, activePart(c));
    if (command) editor.run(command);
  },
});

const ghostBy =
  (dx: number, dy: number): MoveGhost =>
  (e) =>
    e.placement.again(e.scene.peek()!, dx, dy);

const DIRECTIONS = [
  ['Left', -1, 0],
  ['Right', 1, 0],
  ['Up', 0, 1],
  ['Down', 0, -1],
] as const;

const nudges = DIRECTIONS.flatMap(([key, dx, dy]) => {
  const word = key.toLowerCase();
  const help = 'Moves the start, or the goal when that is active';
  return [
    move(`nudge-${word}`, `0.1 m ${word}`, key, help, (e, a, p) => moves.nudge(e, a, p, dx * 0.1, dy * 0.1), {
      all: (all) => several.moveAll(all, dx * 0.1, dy * 0.1, false, 'nudge'),
      ghost: ghostBy(dx * 0.5, dy * 0.5),
    }),
    move(
      `nudge-far-${word}`,
      `1 m ${word}`,
      `Shift+${key}`,
      'Ten times as far',
      (e, a, p) => moves.nudge(e, a, p, dx, dy),
      { all: (all) => several.moveAll(all, dx, dy, false, 'nudge'), ghost: ghostBy(dx * 5, dy * 5) },
    ),
  ];
});

const alongLane = (id: string, label: string, key: string, metres: number) =>
  move(id, label, key, 'Follows the lane', (e, a, p) => moves.nudgeAlong(e, a, p, metres));
const nextLane = (id: string, label: string, key: string, side: 1 | -1) =>
  move(id, label, key, 'Keeps the distance along the road', (e, a, p) => moves.toNextLane(e, a, p, side));
const turn = (id: string, label: string, key: string, degrees: number) =>
  move(id, label, key, 'Heading of the active part; several turn together', (e, a, p) => moves.turn(e, a, p, degrees), {
    all: (all) => several.turnAll(all, rad(degrees), several.middleOf(all), false, 'turn'),
    ghost: (e) => e.placement.turnBy(e.scene.peek()!, rad(degrees)),
  });
const faster = (id: string, label: string, key: string, steps: number) =>
  move(
    id,
    label,
    key,
    Math.abs(steps) === 1 ? '1 km/h, or 0.1 m/s on foot' : '10 km/h, or 1 m/s on foot',
    (e, a, p) => moves.faster(e, a, p, steps),
    { all: (all) => several.fasterAll(all, steps) },
  );

export const movement = inGroup('Move', [
  ...nudges,
  alongLane('along-forward', '1 m on along the lane', 'Ctrl+Up', 1),
  alongLane('along-back', '1 m back along the lane', 'Ctrl+Down', -1),
  nextLane('lane-left', 'To the lane on the left', 'Ctrl+Left', 1),
  nextLane('lane-right', 'To the lane on the right', 'Ctrl+Right', -1),
  turn('turn-left', 'Turn left 1°', '[', 1),
  turn('turn-right', 'Turn right 1°', ']', -1),
  turn('turn-left-far', 'Turn left 15°', 'Shift+[', 15),
  turn('turn-right-far', 'Turn right 15°', 'Shift+]', -15),
  faster('faster', 'Faster', '+', 1),
  faster('slower', 'Slower', '-', -1),
  faster('faster-far', 'Much faster', 'Shift++', 10),
  faster('slower-far', 'Much slower', 'Shift+-', -10),
  move('snap', 'To the nearest lane', 'N', 'Position and heading', moves.snapToNearest, { icon: 'fit' }),
  {
    id: 'switch-part',
    label: 'Start or goal',
    keys: ['X'],
    help: 'Which of the two the keys move',
    when: hasAgent,
    run(c) {
      const part = activePart(c) === 'start' ? 'goal' : 'start';
      c.editor.activate(part);
      c.editor.notices.say(part === 'goal' ? 'Keys move the goal.' : 'Keys move the start.');
    },
  },
  {
    id: 'inspect',
    label: 'To the inspector',
    keys: ['Enter'],
    help: 'Type exact values',
    when: hasAgent,
    run: (c) => c.focusField(activePart(c), 'speed'),
  },
]);
