// Move: the start or the goal of the selected road user, by keys.
import type { Help } from '../texts/desk/helps';
import type { Agent } from '../model/document/scene';
import type { Command } from '../model/document/commands';
import type { View } from '../draw/view';
import type { Context } from './context';
import type { Editor } from '../edit/session/editor';
import type { HandlePart } from '../edit/session/drag';
import { freeOnes } from '../edit/moves/copying';
import * as moves from '../edit/moves/moves';
import * as several from '../edit/moves/several';
import { rad } from '../model/base/geometry';
import { placedBy } from './place';
import { activePart, hasAgent, hasFree, hasSomeFree, inGroup, type Action } from './action';
import { TEXTS } from '../texts/desk/actions';

type KeyMove = (e: Editor, a: Agent, part: HandlePart, v: View) => Command | null;
/** The same for several; a move without it applies to a single one. */
type MoveAll = (all: readonly Agent[], v: View) => Command | null;
/** The same for a road user about to be placed; false where there is none. */
type MoveGhost = (c: Context) => boolean;

interface Also {
  readonly icon?: string;
  readonly all?: MoveAll;
  readonly ghost?: MoveGhost;
}

const move = (
  id: string,
  label: string,
  key: string,
  help: Help,
  make: KeyMove,
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
    const v = c.stage.view;
    if (ghost && placedBy(c)) {
      ghost(c);
      return;
    }
    const many = all && editor.selected.peek().length > 1;
    const free = many ? freeOnes(editor) : [];
    const a = editor.agent.peek();
    const command = many ? free.length && all(free, v) : a && make(editor, a, activePart(c), v);
    if (command) editor.commits.run(command);
  },
});

const ghostBy =
  (right: number, up: number): MoveGhost =>
  ({ editor, placement, stage }) =>
    placement.again(editor.scene.peek()!, ...stage.view.along(right, up));

const DIRECTIONS = [
  ['Left', TEXTS.at01MLeft, TEXTS.at1MLeft, -1, 0],
  ['Right', TEXTS.at01MRight, TEXTS.at1MRight, 1, 0],
  ['Up', TEXTS.at01MUp, TEXTS.at1MUp, 0, 1],
  ['Down', TEXTS.at01MDown, TEXTS.at1MDown, 0, -1],
] as const;

/** Screen directions: left is left also in a turned picture. */
const nudges = DIRECTIONS.flatMap(([key, near, far, right, up]) => {
  const word = key.toLowerCase();
  const help = 'movesTheStart';
  return [
    move(`nudge-${word}`, near, key, help, (e, a, p, v) => moves.nudge(e, a, p, ...v.along(right * 0.1, up * 0.1)), {
      all: (all, v) => several.moveAll(all, ...v.along(right * 0.1, up * 0.1), false, 'nudge'),
      ghost: ghostBy(right * 0.5, up * 0.5),
    }),
    move(
      `nudge-far-${word}`,
      far,
      `Shift+${key}`,
      'tenTimesAs',
      (e, a, p, v) => moves.nudge(e, a, p, ...v.along(right, up)),
      {
        all: (all, v) => several.moveAll(all, ...v.along(right, up), false, 'nudge'),
        ghost: ghostBy(right * 5, up * 5),
      },
    ),
  ];
});

const alongLane = (id: string, label: string, key: string, metres: number) =>
  move(id, label, key, 'followsThe', (e, a, p) => moves.nudgeAlong(e, a, p, metres));
const nextLane = (id: string, label: string, key: string, side: 1 | -1) =>
  move(id, label, key, 'keepsThePosition', (e, a, p) => moves.toNextLane(e, a, p, side));
const turn = (id: string, label: string, key: string, degrees: number) =>
  move(id, label, key, 'turnsTheActivePart', (e, a, p) => moves.turn(e, a, p, degrees), {
    all: (all) => several.turnAll(all, rad(degrees), several.middleOf(all), false, 'turn'),
    ghost: ({ editor, placement }) => placement.turnBy(editor.scene.peek()!, rad(degrees)),
  });
const faster = (id: string, label: string, key: string, steps: number) =>
  move(
    id,
    label,
    key,
    Math.abs(steps) === 1 ? 'by1KmHOr01MS' : 'by10KmHOr1MS',
    (e, a, p) => moves.faster(e, a, p, steps),
    { all: (all) => several.fasterAll(all, steps) },
  );

export const movement = inGroup('move', [
  ...nudges,
  alongLane('along-forward', TEXTS.at1MOnAlongThe, 'Ctrl+Up', 1),
  alongLane('along-back', TEXTS.at1MBackAlongThe, 'Ctrl+Down', -1),
  nextLane('lane-left', TEXTS.toTheLaneOnThe, 'Ctrl+Left', 1),
  nextLane('lane-right', TEXTS.toTheLaneOnTheRight, 'Ctrl+Right', -1),
  turn('turn-left', TEXTS.turnLeft1, '[', 1),
  turn('turn-right', TEXTS.turnRight1, ']', -1),
  turn('turn-left-far', TEXTS.turnLeft15, 'Shift+[', 15),
  turn('turn-right-far', TEXTS.turnRight15, 'Shift+]', -15),
  faster('faster', TEXTS.faster, '+', 1),
  faster('slower', TEXTS.slower, '-', -1),
  faster('faster-far', TEXTS.muchFaster, 'Shift++', 10),
  faster('slower-far', TEXTS.muchSlower, 'Shift+-', -10),
  move('snap', TEXTS.toTheNearest, 'N', 'positionAnd', moves.snapToNearest, { icon: 'fit' }),
  {
    id: 'drive',
    label: TEXTS.driveByKeyboard,
    keys: ['Shift+E'],
    icon: 'car',
    help: 'drivesTheSelected',
    when: hasFree,
    checked: (c) => c.driving.isOn.value,
    run: (c) => {
      c.rounds.close();
      c.variants.comparing.end();
      c.searching.open.peek()?.close();
      void c.driving.begin();
    },
  },
  {
    id: 'switch-part',
    label: TEXTS.startOrGoal,
    keys: ['X'],
    help: 'whichOfThe',
    when: hasAgent,
    run(c) {
      const part = activePart(c) === 'start' ? 'goal' : 'start';
      c.editor.activate(part);
      c.editor.notices.say(part === 'goal' ? TEXTS.keysMoveTheGoal : TEXTS.keysMoveTheStart);
    },
  },
  {
    id: 'inspect',
    label: TEXTS.toTheInspector,
    keys: ['Enter'],
    help: 'typeExactValues',
    when: hasAgent,
    run: (c) => c.focusField(activePart(c), 'speed'),
  },
]);
