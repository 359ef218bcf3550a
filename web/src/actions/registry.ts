// The one list of everything a user can do. Menus, buttons, palette, shortcut sheet and tooltips are made from it.
import type { Context } from './context';
import type { Part } from '../edit/editor';
import { canChange, hasGoal, LENGTHS, REPLANS, touched, type Agent } from '../model/scene';
import {
  clearGoal,
  resetAgent,
  resetAll,
  setLength,
  setOthers,
  setReplan,
  setSeed,
  type Command,
} from '../model/commands';
import { LETTERS } from '../model/futures';
import { STEP_S } from '../model/motion';
import * as moves from '../edit/moves';
import { RATES } from '../edit/playback';
import { download } from '../edit/download';

export type Group = 'Select and look' | 'Move' | 'Goal and futures' | 'Time' | 'Scene' | 'Everything';

export interface Action {
  readonly id: string;
  readonly label: string;
  readonly group: Group;
  readonly help: string;
  readonly keys?: readonly string[];
  readonly icon?: string;
  /** Where its keys work: everywhere, or only while no text field has the focus. */
  readonly context?: 'always';
  /** True when possible; words say why not. */
  when?(c: Context): true | string;
  checked?(c: Context): boolean;
  run(c: Context): void;
  readonly undo: 'command' | 'none';
}

const hasScene = (c: Context): true | string => (c.editor.scene.value ? true : 'No scene is open.');
const hasAgent = (c: Context): true | string => {
  const a = c.editor.agent.value;
  return !a ? 'Select a road user first.' : canChange(a) ? true : 'This one can be looked at, not changed.';
};
const part = (c: Context): Part => c.editor.focusPart.value;

/** Does a command on the selected road user, when there is one and the command makes sense. */
function onAgent(make: (c: Context, a: Agent) => Command | null): (c: Context) => void {
  return (c) => {
    const a = c.editor.agent.value;
    const command = a && canChange(a) ? make(c, a) : null;
    if (command) c.editor.run(command);
  };
}

const list: Action[] = [];
const add = (...a: Action[]): void => {
  list.push(...a);
};

function agentAction(
  id: string,
  label: string,
  group: Group,
  keys: string[],
  help: string,
  make: (c: Context, a: Agent) => Command | null,
  icon?: string,
): Action {
  return { id, label, group, keys, help, icon, when: hasAgent, run: onAgent(make), undo: 'command' };
}

// ---- Select and look
const tool = (name: 'select' | 'pan' | 'measure', label: string, key: string, icon: string, help: string): Action => ({
  id: `tool-${name}`,
  label,
  group: 'Select and look',
  keys: [key],
  icon,
  help,
  undo: 'none',
  checked: (c) => c.editor.tool.value === name,
  run: (c) => {
    c.editor.tool.value = name;
    c.editor.measure.value = null;
  },
});
add(
  tool('select', 'Select and drag', 'V', 'select', 'Click a road user, drag its handles'),
  tool('pan', 'Move the picture', 'H', 'hand', 'Dragging moves the picture wherever it starts'),
  tool('measure', 'Measure', 'M', 'ruler', 'Drag a line to read its length'),
);
const byDistance = (c: Context): string[] => {
  const v = c.stage.view,
    s = c.editor.scene.value;
  if (!s) return [];
  const [x, y] = v.from(v.w / 2, v.h / 2);
  return [...s.agents.values()]
    .filter(canChange)
    .map((a) => ({ id: a.id, d: Math.hypot((a.logStart?.x ?? 0) - x, (a.logStart?.y ?? 0) - y) }))
    .sort((p, q) => p.d - q.d)
    .map((p) => p.id);
};
let walk: { ids: string[]; scene: unknown } | null = null;
function walkTo(c: Context, step: 1 | -1): void {
  const scene = c.editor.scene.value?.id;
  // The order is kept while one walks, or the next key would jump back to the middle.
  if (!walk || walk.scene !== scene || !c.editor.selection.value) walk = { ids: byDistance(c), scene };
  const at = walk.ids.indexOf(c.editor.selection.value ?? '');
  const id = walk.ids[at < 0 ? (step > 0 ? 0 : walk.ids.length - 1) : (at + step + walk.ids.length) % walk.ids.length];
  if (!id) return;
  c.editor.select(id);
  c.focusAgent(id);
}
const zoom = (c: Context, k: number): void => {
  const v = c.stage.view;
  v.zoomAt(v.w / 2, v.h / 2, k);
  c.stage.viewChanged();
};
const layer = (name: 'futures' | 'log' | 'lanes' | 'labels', label: string, help: string, keys: string[]): Action => ({
  id: `layer-${name}`,
  label,
  group: 'Select and look',
  keys,
  help,
  undo: 'none',
  when: hasScene,
  checked: (c) => c.editor.layers.value[name],
  run: (c) => {
    c.editor.layers.value = { ...c.editor.layers.value, [name]: !c.editor.layers.value[name] };
  },
});
add(
  {
    id: 'next-agent',
    label: 'Next road user',
    group: 'Select and look',
    keys: ['Tab'],
    help: 'Nearest to the middle of the picture first',
    undo: 'none',
    when: hasScene,
    run: (c) => walkTo(c, 1),
  },
  {
    id: 'previous-agent',
    label: 'Previous road user',
    group: 'Select and look',
    keys: ['Shift+Tab'],
    help: 'The way back',
    undo: 'none',
    when: hasScene,
    run: (c) => walkTo(c, -1),
  },
  {
    id: 'deselect',
    label: 'Let go, close, put back',
    group: 'Everything',
    keys: ['Esc'],
    help: 'Cancels a drag, then closes what is open, then selects nothing',
    context: 'always',
    undo: 'none',
    run(c) {
      if (c.gestures.cancel()) return;
      if (c.ui.dialog.value || c.ui.menu.value) {
        c.ui.dialog.value = null;
        c.ui.menu.value = null;
        return;
      }
      if (c.ui.deleting.value) {
        c.ui.deleting.value = null;
        return;
      }
      if (c.library.imports.value) {
        c.library.imports.value = null;
        return;
      }
      if (c.ui.eventsPanel.value) {
        c.ui.eventsPanel.value = false;
        c.editor.selectedEvent.value = null;
        return;
      }
      if (c.editor.tool.value !== 'select') {
        c.editor.tool.value = 'select';
        c.editor.measure.value = null;
        return;
      }
      c.editor.select(null);
    },
  },
  {
    id: 'fit',
    label: 'Fit the scene',
    group: 'Select and look',
    keys: ['0'],
    icon: 'fit',
    help: 'The whole map in view',
    undo: 'none',
    when: hasScene,
    run: (c) => c.fit(),
  },
  {
    id: 'zoom-selection',
    label: 'Zoom to selection',
    group: 'Select and look',
    keys: ['Z'],
    icon: 'search',
    help: 'The selected road user and its goal',
    undo: 'none',
    when: hasAgent,
    run(c) {
      const a = c.editor.agent.value!,
        p = a.logStart!,
        g = c.editor.goalPose(a) ?? p;
      c.stage.view.fit(
        {
          x0: Math.min(p.x, g.x) - 18,
          x1: Math.max(p.x, g.x) + 18,
          y0: Math.min(p.y, g.y) - 18,
          y1: Math.max(p.y, g.y) + 18,
        },
        22,
      );
      c.stage.viewChanged();
    },
  },
  {
    id: 'zoom-in',
    label: 'Zoom in',
    group: 'Select and look',
    keys: ['PageUp'],
    icon: 'plus',
    help: 'A third closer',
    undo: 'none',
    run: (c) => zoom(c, 1.33),
  },
  {
    id: 'zoom-out',
    label: 'Zoom out',
    group: 'Select and look',
    keys: ['PageDown'],
    icon: 'minus',
    help: 'A third further',
    undo: 'none',
    run: (c) => zoom(c, 1 / 1.33),
  },
  {
    id: 'follow',
    label: 'Keep in view',
    group: 'Select and look',
    keys: ['K'],
    icon: 'eye',
    help: 'The picture follows the selected road user in playback',
    undo: 'none',
    when: hasAgent,
    checked: (c) => c.editor.follow.value,
    run: (c) => {
      c.editor.follow.value = !c.editor.follow.value;
    },
  },
  layer('futures', 'Futures', 'Where everybody may go', ['Shift+O']),
  layer('log', 'Log', 'What was recorded, dashed', ['O']),
  layer('lanes', 'Lanes', 'Centre lines of the lanes', ['Shift+K']),
  layer('labels', 'Labels', 'Names of the road users', ['Shift+L']),
);

// ---- Move
for (const [key, dx, dy, word] of [
  ['Left', -1, 0, 'left'],
  ['Right', 1, 0, 'right'],
  ['Up', 0, 1, 'up'],
  ['Down', 0, -1, 'down'],
] as const) {
  add(
    agentAction(
      `nudge-${word}`,
      `0.1 m ${word}`,
      'Move',
      [key],
      'Moves the start, or the goal when that is active',
      (c, a) => moves.nudge(c.editor, a, part(c), dx * 0.1, dy * 0.1),
    ),
  );
  add(
    agentAction(`nudge-far-${word}`, `1 m ${word}`, 'Move', [`Shift+${key}`], 'Ten times as far', (c, a) =>
      moves.nudge(c.editor, a, part(c), dx, dy),
    ),
  );
}
add(
  agentAction('along-forward', '1 m on along the lane', 'Move', ['Ctrl+Up'], 'Follows the lane', (c, a) =>
    moves.nudgeAlong(c.editor, a, part(c), 1),
  ),
  agentAction('along-back', '1 m back along the lane', 'Move', ['Ctrl+Down'], 'Follows the lane', (c, a) =>
    moves.nudgeAlong(c.editor, a, part(c), -1),
  ),
  agentAction(
    'lane-left',
    'To the lane on the left',
    'Move',
    ['Ctrl+Left'],
    'Keeps the distance along the road',
    (c, a) => moves.toNextLane(c.editor, a, part(c), 1),
  ),
  agentAction(
    'lane-right',
    'To the lane on the right',
    'Move',
    ['Ctrl+Right'],
    'Keeps the distance along the road',
    (c, a) => moves.toNextLane(c.editor, a, part(c), -1),
  ),
  agentAction('turn-left', 'Turn left 1°', 'Move', ['['], 'Heading of the active part', (c, a) =>
    moves.turn(c.editor, a, part(c), 1),
  ),
  agentAction('turn-right', 'Turn right 1°', 'Move', [']'], 'Heading of the active part', (c, a) =>
    moves.turn(c.editor, a, part(c), -1),
  ),
  agentAction('turn-left-far', 'Turn left 15°', 'Move', ['Shift+['], 'Heading of the active part', (c, a) =>
    moves.turn(c.editor, a, part(c), 15),
  ),
  agentAction('turn-right-far', 'Turn right 15°', 'Move', ['Shift+]'], 'Heading of the active part', (c, a) =>
    moves.turn(c.editor, a, part(c), -15),
  ),
  agentAction('faster', 'Faster', 'Move', ['+'], '1 km/h, or 0.1 m/s on foot', (c, a) =>
    moves.faster(c.editor, a, part(c), 1),
  ),
  agentAction('slower', 'Slower', 'Move', ['-'], '1 km/h, or 0.1 m/s on foot', (c, a) =>
    moves.faster(c.editor, a, part(c), -1),
  ),
  agentAction('faster-far', 'Much faster', 'Move', ['Shift++'], '10 km/h, or 1 m/s on foot', (c, a) =>
    moves.faster(c.editor, a, part(c), 10),
  ),
  agentAction('slower-far', 'Much slower', 'Move', ['Shift+-'], '10 km/h, or 1 m/s on foot', (c, a) =>
    moves.faster(c.editor, a, part(c), -10),
  ),
  agentAction(
    'snap',
    'To the nearest lane',
    'Move',
    ['N'],
    'Position and heading',
    (c, a) => moves.snapToNearest(c.editor, a, part(c)),
    'fit',
  ),
  {
    id: 'switch-part',
    label: 'Start or goal',
    group: 'Move',
    keys: ['X'],
    help: 'Which of the two the keys move',
    undo: 'none',
    when: hasAgent,
    run(c) {
      c.editor.focusPart.value = part(c) === 'start' ? 'goal' : 'start';
      c.editor.say(part(c) === 'goal' ? 'Keys move the goal.' : 'Keys move the start.');
    },
  },
  {
    id: 'inspect',
    label: 'To the inspector',
    group: 'Move',
    keys: ['Enter'],
    help: 'Type exact values',
    undo: 'none',
    when: hasAgent,
    run: (c) => c.focusField(part(c), 'speed'),
  },
);

// ---- Goal and futures
add(
  {
    ...agentAction(
      'set-goal',
      'Set a goal',
      'Goal and futures',
      ['G'],
      'Where the chosen future ends; then move it',
      (c, a) => {
        c.editor.focusPart.value = 'goal';
        return a.goal.pos ? null : moves.goalHere(c.editor, a);
      },
      'flag',
    ),
  },
  {
    ...agentAction(
      'clear-goal',
      'Clear the goal',
      'Goal and futures',
      ['Shift+G'],
      'The generator decides again',
      (_, a) => (hasGoal(a.goal) ? clearGoal(a) : null),
      'x',
    ),
  },
  agentAction(
    'toggle-field',
    'Fixed or free',
    'Goal and futures',
    ['F'],
    'The field touched last',
    (c, a) => moves.toggleField(c.editor, a, c.editor.lastField.value.part, c.editor.lastField.value.field),
    'lock',
  ),
  agentAction(
    'toggle-goal-speed',
    'Fix or free the goal speed',
    'Goal and futures',
    ['Shift+F'],
    'Free lets the generator choose it',
    (c, a) => moves.toggleField(c.editor, a, 'goal', 'speed'),
    'lock',
  ),
  agentAction('free-speed', 'Speed free', 'Goal and futures', ['Backspace'], 'Speed of the active part', (c, a) =>
    (part(c) === 'goal' ? a.goal : a.start).speed === null ? null : moves.toggleField(c.editor, a, part(c), 'speed'),
  ),
  agentAction('goal-earlier', 'Goal 0.1 s earlier', 'Goal and futures', [';'], 'Time at the goal', (c, a) =>
    moves.later(c.editor, a, -0.1),
  ),
  agentAction('goal-later', 'Goal 0.1 s later', 'Goal and futures', ["'"], 'Time at the goal', (c, a) =>
    moves.later(c.editor, a, 0.1),
  ),
  agentAction('goal-earlier-far', 'Goal 1 s earlier', 'Goal and futures', ['Shift+;'], 'Time at the goal', (c, a) =>
    moves.later(c.editor, a, -1),
  ),
  agentAction('goal-later-far', 'Goal 1 s later', 'Goal and futures', ["Shift+'"], 'Time at the goal', (c, a) =>
    moves.later(c.editor, a, 1),
  ),
);
for (let i = 0; i < 6; i++)
  add(
    agentAction(
      `future-${LETTERS[i].toLowerCase()}`,
      `Choose future ${LETTERS[i]}`,
      'Goal and futures',
      [`Alt+${i + 1}`],
      'Playback follows it and the others answer',
      (c, a) => moves.pickFuture(c.editor, a, i),
    ),
  );
add(
  agentAction(
    'future-best',
    'Back to the most likely future',
    'Goal and futures',
    ['Alt+0'],
    'The generator chooses again',
    (c, a) => (a.chosen === null ? null : moves.pickFuture(c.editor, a, null)),
  ),
  {
    id: 'generate',
    label: 'Generate',
    group: 'Goal and futures',
    keys: ['Ctrl+Enter'],
    icon: 'play',
    help: 'Everybody worked out anew with this seed',
    context: 'always',
    undo: 'none',
    when: hasScene,
    run: (c) => c.asking.generateAll(),
  },
  {
    id: 'new-seed',
    label: 'New seed',
    group: 'Goal and futures',
    keys: ['R'],
    icon: 'dice',
    help: 'Other futures for the same scene',
    undo: 'command',
    when: hasScene,
    run: (c) => c.editor.run(setSeed(1 + Math.floor(Math.random() * 9999))),
  },
  agentAction(
    'reset-agent',
    'Reset to log',
    'Goal and futures',
    ['Shift+R'],
    'This road user as it was recorded',
    (_, a) => (touched(a) ? resetAgent(a) : null),
    'undo',
  ),
);

// ---- Time
const step = (c: Context, n: number): void => {
  c.editor.playing.value = false;
  c.editor.setTime((Math.round(c.editor.time.value / STEP_S) + n) * STEP_S);
};
const rate = (c: Context, d: number): void => {
  const i = RATES.indexOf(c.editor.rate.value as (typeof RATES)[number]);
  c.editor.rate.value = RATES[Math.min(RATES.length - 1, Math.max(0, i + d))];
};
add(
  {
    id: 'play',
    label: 'Play or pause',
    group: 'Time',
    keys: ['Space'],
    icon: 'play',
    help: 'Runs from the playhead',
    undo: 'none',
    when: hasScene,
    checked: (c) => c.editor.playing.value,
    run: (c) => c.playback.toggle(),
  },
  {
    id: 'step-back',
    label: '0.1 s back',
    group: 'Time',
    keys: [','],
    help: 'One frame',
    undo: 'none',
    when: hasScene,
    run: (c) => step(c, -1),
  },
  {
    id: 'step-on',
    label: '0.1 s on',
    group: 'Time',
    keys: ['.'],
    help: 'One frame',
    undo: 'none',
    when: hasScene,
    run: (c) => step(c, 1),
  },
  {
    id: 'to-start',
    label: 'To the start',
    group: 'Time',
    keys: ['Home'],
    icon: 'prev',
    help: 'Playhead to 0.0 s',
    undo: 'none',
    when: hasScene,
    run: (c) => {
      c.editor.playing.value = false;
      c.editor.setTime(0);
    },
  },
  {
    id: 'to-end',
    label: 'To the end',
    group: 'Time',
    keys: ['End'],
    icon: 'next',
    help: 'Playhead to the last frame',
    undo: 'none',
    when: hasScene,
    run: (c) => {
      c.editor.playing.value = false;
      c.editor.setTime(99);
    },
  },
  {
    id: 'slower-playback',
    label: 'Slower playback',
    group: 'Time',
    keys: ['Shift+,'],
    help: 'Down to 0.1×',
    undo: 'none',
    run: (c) => rate(c, -1),
  },
  {
    id: 'faster-playback',
    label: 'Faster playback',
    group: 'Time',
    keys: ['Shift+.'],
    help: 'Up to 8×',
    undo: 'none',
    run: (c) => rate(c, 1),
  },
  {
    id: 'loop',
    label: 'Loop',
    group: 'Time',
    keys: ['P'],
    icon: 'loop',
    help: 'Start again at the end',
    undo: 'none',
    checked: (c) => c.editor.loop.value,
    run: (c) => {
      c.editor.loop.value = !c.editor.loop.value;
    },
  },
  {
    id: 'next-event',
    label: 'Next event',
    group: 'Time',
    keys: ['E'],
    icon: 'warn',
    help: 'Collision or near miss after the playhead',
    undo: 'none',
    when: (c) => (c.editor.events.value.length ? true : 'There are no events.'),
    run(c) {
      const ev = c.editor.events.value;
      const next =
        ev.find(
          (v) =>
            v.time > c.editor.time.value + 0.05 ||
            (v.time >= c.editor.time.value && v !== c.editor.selectedEvent.value),
        ) ?? ev[0];
      if (!next) return;
      c.editor.playing.value = false;
      c.ui.eventsPanel.value = true;
      c.editor.setTime(next.time);
      c.editor.selectedEvent.value = next;
    },
  },
);

for (const s of LENGTHS)
  add({
    id: `length-${s}`,
    label: `Length ${s} s`,
    group: 'Time',
    keys: [],
    help:
      s > 9 ? `Work out ${s} s: past 9 s everybody plans anew from where they are by then` : 'Work out 9 s, in one go',
    undo: 'command',
    when: hasScene,
    checked: (c) => c.editor.scene.value?.length === s,
    run: (c) => {
      if (c.editor.scene.peek()!.length !== s) c.editor.run(setLength(c.editor.scene.peek()!, s));
    },
  });
for (const s of REPLANS)
  add({
    id: `replan-${s}`,
    label: `Plan anew each ${s} s`,
    group: 'Time',
    keys: [],
    help: `Everybody looks again every ${s} s and plans on from there`,
    undo: 'command',
    when: hasScene,
    checked: (c) => c.editor.scene.value?.replan === s,
    run: (c) => {
      if (c.editor.scene.peek()!.replan !== s) c.editor.run(setReplan(s));
    },
  });

// ---- Scene
add(
  {
    id: 'scenes',
    label: 'Scenes',
    group: 'Scene',
    keys: ['B'],
    icon: 'list',
    help: 'List of scenes',
    undo: 'none',
    checked: (c) => c.ui.drawer.value,
    run: (c) => {
      c.ui.drawer.value = !c.ui.drawer.value;
    },
  },
  {
    id: 'choose-files',
    label: 'Choose files',
    group: 'Scene',
    keys: ['Ctrl+O'],
    icon: 'file',
    help: 'Scenario records, lane maps and saved scenes',
    undo: 'none',
    context: 'always',
    run: (c) => c.chooseFiles(),
  },
  {
    id: 'save-copy',
    label: 'Save a copy',
    group: 'Scene',
    keys: ['Ctrl+S'],
    icon: 'copy',
    help: 'An own scene that saves itself',
    context: 'always',
    undo: 'none',
    when: hasScene,
    run: (c) => void c.library.saveCopy(),
  },
  {
    id: 'export-json',
    label: 'Export scene (JSON)',
    group: 'Scene',
    keys: [],
    icon: 'export',
    help: 'Everything, to be opened again here',
    undo: 'none',
    when: hasScene,
    run: (c) => void download(c, 'dragtraffic'),
  },
  {
    id: 'export-womd',
    label: 'Export scenario record (Waymo TFRecord)',
    group: 'Scene',
    keys: [],
    icon: 'export',
    help: 'The motion on screen as a Scenario record',
    undo: 'none',
    when: hasScene,
    run: (c) => void download(c, 'womd'),
  },
  {
    id: 'others-react',
    label: 'Others react',
    group: 'Scene',
    keys: [],
    help: 'Everybody you gave no goal adapts when you let go',
    undo: 'command',
    when: hasScene,
    checked: (c) => c.editor.scene.value?.others === 'react',
    run: (c) => c.editor.run(setOthers('react')),
  },
  {
    id: 'others-log',
    label: 'Others replay the log',
    group: 'Scene',
    keys: [],
    help: 'They do what was recorded',
    undo: 'command',
    when: hasScene,
    checked: (c) => c.editor.scene.value?.others === 'log',
    run: (c) => c.editor.run(setOthers('log')),
  },
  {
    id: 'others-still',
    label: 'Others hold still',
    group: 'Scene',
    keys: [],
    help: 'They stay where they start, and nobody else comes in',
    undo: 'command',
    when: hasScene,
    checked: (c) => c.editor.scene.value?.others === 'still',
    run: (c) => c.editor.run(setOthers('still')),
  },
  {
    id: 'delete-scene',
    label: 'Delete this scene',
    group: 'Scene',
    keys: [],
    icon: 'trash',
    help: 'Asks first; examples stay',
    undo: 'none',
    when: (c) =>
      !c.editor.scene.value
        ? 'No scene is open.'
        : c.library.isOwn(c.editor.scene.value.id)
          ? true
          : 'Examples cannot be deleted.',
    run: (c) => {
      c.ui.deleting.value = c.editor.scene.value!.id;
    },
  },
  {
    id: 'reset-all',
    label: 'Everybody back to the log',
    group: 'Scene',
    keys: [],
    icon: 'undo',
    help: 'Drops every change; can be undone',
    undo: 'command',
    when: hasScene,
    run: (c) => c.editor.run(resetAll(c.editor.scene.value!)),
  },
);

// ---- Everything
add(
  {
    id: 'palette',
    label: 'Actions',
    group: 'Everything',
    keys: ['Ctrl+K'],
    icon: 'search',
    help: 'Find and do anything',
    context: 'always',
    undo: 'none',
    run: (c) => {
      c.ui.dialog.value = c.ui.dialog.value === 'palette' ? null : 'palette';
    },
  },
  {
    id: 'undo',
    label: 'Undo',
    group: 'Everything',
    keys: ['Ctrl+Z'],
    icon: 'undo',
    help: 'One step back',
    undo: 'none',
    when: (c) => (c.editor.undoName.value ? true : 'Nothing to undo.'),
    run: (c) => c.editor.undo(),
  },
  {
    id: 'redo',
    label: 'Redo',
    group: 'Everything',
    keys: ['Ctrl+Shift+Z', 'Ctrl+Y'],
    icon: 'redo',
    help: 'One step on again',
    undo: 'none',
    when: (c) => (c.editor.redoName.value ? true : 'Nothing to redo.'),
    run: (c) => c.editor.redo(),
  },
  {
    id: 'shortcuts',
    label: 'Shortcuts',
    group: 'Everything',
    keys: ['?'],
    icon: 'help',
    help: 'This list',
    undo: 'none',
    run: (c) => {
      c.ui.dialog.value = 'shortcuts';
    },
  },
  {
    id: 'theme',
    label: 'Light or dark',
    group: 'Everything',
    keys: ['Shift+D'],
    icon: 'moon',
    help: 'Colours of the page',
    undo: 'none',
    run: (c) => c.ui.setTheme(c.ui.theme.value === 'dark' ? 'light' : 'dark'),
  },
  {
    id: 'next-group',
    label: 'Next part of the page',
    group: 'Everything',
    keys: ['F6'],
    help: 'Top bar, scenes, road users, inspector, timeline',
    context: 'always',
    undo: 'none',
    run: (c) => c.focusGroup(1),
  },
  {
    id: 'previous-group',
    label: 'Previous part of the page',
    group: 'Everything',
    keys: ['Shift+F6'],
    help: 'The way back',
    context: 'always',
    undo: 'none',
    run: (c) => c.focusGroup(-1),
  },
  {
    id: 'coach',
    label: 'Show the first steps',
    group: 'Everything',
    keys: [],
    icon: 'help',
    help: 'The three-step hint',
    undo: 'none',
    run: (c) => {
      c.ui.coach.value = 1;
    },
  },
  {
    id: 'unit',
    label: 'km/h or mph',
    group: 'Everything',
    keys: ['U'],
    icon: 'ruler',
    help: 'Unit of vehicle speeds',
    undo: 'none',
    run: (c) => c.editor.setUnit(c.editor.speedUnit.value === 'km/h' ? 'mph' : 'km/h'),
  },
);

export const ACTIONS: readonly Action[] = Object.freeze(list);
const byId = new Map(ACTIONS.map((a) => [a.id, a]));
const byKey = new Map(ACTIONS.flatMap((a) => (a.keys ?? []).map((k) => [k, a] as const)));

export const actionOf = (id: string): Action => {
  const a = byId.get(id);
  if (!a) throw new Error(`no action ${id}`);
  return a;
};
export const actionForKey = (key: string): Action | undefined => byKey.get(key);
export const possible = (c: Context, a: Action): true | string => a.when?.(c) ?? true;

export function perform(c: Context, id: string): void {
  const a = actionOf(id);
  const can = possible(c, a);
  if (can === true) a.run(c);
  else c.editor.say(can);
}
