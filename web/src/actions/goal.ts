// Goal and futures: what is asked of the selected road user, which future it takes, and working everything out.
import { canChange, changedByHand, hasGoal, type Agent } from '../model/scene';
import { clearGoal, resetAgent, setSeed, type Command } from '../model/commands';
import { LETTERS } from '../model/futures';
import type { Editor } from '../edit/editor';
import * as moves from '../edit/moves';
import { leaveToCross, roadWay } from '../edit/ways-out';
import { clearGoals } from '../edit/several';
import { addVia, removeVia, roomForVia } from '../edit/vias';
import { activePart, hasFree, hasScene, hasSomeFree, inGroup, onAgent, onSome, type Action } from './action';
import type { Context } from './context';

const LARGEST_NEW_SEED = 9999;

const goalTime = (id: string, label: string, key: string, seconds: number): Omit<Action, 'group'> => ({
  id,
  label,
  keys: [key],
  help: 'Time at the goal',
  ...onAgent((c, a) => moves.later(c.editor, a, seconds)),
});

/** A way out of a goal that is reached against the rules; in the middle of a drag it ends the drag. */
const wayOut = (find: (e: Editor, a: Agent) => { command: Command } | null, none: string) => {
  const found = ({ editor }: Context) => {
    const a = editor.agent.value;
    return a && canChange(a) ? find(editor, a) : null;
  };
  return {
    onOffer: (c: Context) => found(c) !== null,
    when: (c: Context) => (found(c) ? true : none),
    run(c: Context) {
      const way = found(c);
      if (c.editor.dragging.peek()) c.gestures.cancel();
      if (way) c.editor.run(way.command);
    },
  };
};

const futures = [...LETTERS].map((letter, i) => ({
  id: `future-${letter.toLowerCase()}`,
  label: `Choose future ${letter}`,
  keys: [`Alt+${i + 1}`],
  help: 'Playback follows it and the others answer',
  ...onAgent((c, a) => {
    if (!c.rounds.isOpen.peek()) return moves.pickFuture(c.editor, a, i);
    c.rounds.take(i);
    return null;
  }),
}));

/** The future that a menu is about, or that is pointed at. */
const pointed = ({ editor, ui }: Context): number | null => ui.contextMenu.value?.future ?? editor.hoverFuture.value;

const onPointed = (run: (c: Context, a: Agent, i: number) => void): Pick<Action, 'when' | 'run'> => ({
  when: (c) => (pointed(c) === null ? 'Point at a future first.' : hasFree(c)),
  run(c) {
    const a = c.editor.agent.peek();
    const i = pointed(c);
    if (a && i !== null) run(c, a, i);
  },
});

function take({ editor }: Context, a: Agent, i: number): void {
  const command = a.chosen === i ? null : moves.pickFuture(editor, a, i);
  if (command) editor.run(command);
}

function viaInHand({ editor }: Context): { a: Agent; i: number } | null {
  const a = editor.agent.value;
  const i = editor.viaInHand.value;
  return a && i !== null ? { a, i } : null;
}

/** On the future that the menu or the pointer is on; else half way along the one in force. */
function putVia(c: Context): void {
  const { editor, ui, gestures, stage } = c;
  const a = editor.agent.peek();
  if (!a) return;
  const future = pointed(c);
  const at = ui.contextMenu.peek() ?? gestures.pointer;
  const near = future !== null && at ? stage.view.from(at.x, at.y) : null;
  const added = addVia(editor, a, near, future ?? undefined);
  if (!added) return;
  editor.run(added.command);
  editor.takeVia(added.index);
}

const clearing: Pick<Action, 'when' | 'run'> = {
  ...onSome((_, all) => (all.length > 1 ? clearGoals(all) : clearGoal(all[0]))),
  when: (c) => (c.editor.chosenOnes.some((a) => hasGoal(a.goal)) ? hasSomeFree(c) : 'No goal is set.'),
};

const resetting: Pick<Action, 'when' | 'run'> = {
  ...onAgent((_, a) => resetAgent(a)),
  when: (c) => {
    const a = c.editor.agent.value;
    if (!a || a.locked) return hasFree(c);
    return a.placed ? 'Nothing of it was recorded.' : changedByHand(a) ? true : 'It is as it was recorded.';
  },
};

export const goal = inGroup('Goal and futures', [
  {
    id: 'set-goal',
    label: 'Set a goal',
    keys: ['G'],
    icon: 'flag',
    help: 'Where the chosen future ends; then move it',
    ...onAgent((c, a) => {
      c.editor.activate('goal');
      return a.goal.pos ? null : moves.goalHere(c.editor, a);
    }),
  },
  {
    id: 'clear-goal',
    label: 'Clear the goal',
    keys: ['Shift+G'],
    icon: 'x',
    help: 'The generator decides again',
    ...clearing,
  },
  {
    id: 'add-via',
    label: 'Add a via point',
    keys: ['I'],
    icon: 'via',
    help: 'A place to pass on the way: where a future is pointed at, else half way. Shift and a click on a path, too',
    when(c) {
      const a = c.editor.agent.value;
      const free = hasFree(c);
      if (free !== true || !a) return free;
      return c.editor.futures.value ? roomForVia(a) : 'It has no futures yet.';
    },
    run: (c) => putVia(c),
  },
  {
    id: 'remove-via',
    label: 'Remove the via point',
    keys: ['Del', 'Backspace'],
    icon: 'trash',
    help: 'The one that was taken last',
    onOffer: (c) => viaInHand(c) !== null,
    when: (c) => (viaInHand(c) === null ? 'Take a via point first.' : hasFree(c)),
    run(c) {
      const found = viaInHand(c);
      const command = found && removeVia(found.a, found.i);
      if (command) c.editor.run(command);
    },
  },
  {
    id: 'toggle-field',
    label: 'Fixed or free',
    keys: ['F'],
    icon: 'lock',
    help: 'The field touched last',
    ...onAgent(({ editor }, a) => {
      const { part, field } = editor.lastField.value;
      return moves.toggleField(editor, a, part, field);
    }),
  },
  {
    id: 'toggle-goal-speed',
    label: 'Fix or free the goal speed',
    keys: ['Shift+F'],
    icon: 'lock',
    help: 'Free lets the generator choose it',
    ...onAgent((c, a) => moves.toggleField(c.editor, a, 'goal', 'speed')),
  },
  {
    id: 'free-speed',
    label: 'Speed free',
    keys: ['Shift+Backspace'],
    help: 'Speed of the active part',
    ...onAgent((c, a) => {
      const part = activePart(c);
      return a[part].speed === null ? null : moves.toggleField(c.editor, a, part, 'speed');
    }),
  },
  goalTime('goal-earlier', 'Goal 0.1 s earlier', ';', -0.1),
  goalTime('goal-later', 'Goal 0.1 s later', "'", 0.1),
  goalTime('goal-earlier-far', 'Goal 1 s earlier', 'Shift+;', -1),
  goalTime('goal-later-far', 'Goal 1 s later', "Shift+'", 1),
  ...futures,
  {
    id: 'future-choose',
    label: 'Choose this future',
    icon: 'check',
    help: 'Playback follows it and the others answer; it stays chosen',
    ...onPointed(take),
  },
  {
    id: 'future-play',
    label: 'Choose and play it',
    icon: 'play',
    help: 'From the beginning, with what the others do',
    ...onPointed((c, a, i) => {
      take(c, a, i);
      c.editor.setTime(0);
      c.editor.playhead.play();
    }),
  },
  {
    id: 'future-compare',
    label: 'Compare all side by side',
    icon: 'compare',
    help: 'Each future as a variant, with what the others do about it',
    ...onPointed((c) => {
      c.variants.show(true);
      void c.variants.make();
    }),
  },
  {
    id: 'future-best',
    label: 'Back to the most likely future',
    keys: ['Alt+0'],
    help: 'The generator chooses again',
    ...onAgent((c, a) => (a.chosen === null ? null : moves.pickFuture(c.editor, a, null))),
  },
  {
    id: 'by-road',
    label: 'Take the way by the road',
    keys: ['Enter'],
    icon: 'road',
    help: 'The nearest place that the road leads to in the same time, else the future that gets there by it',
    ...wayOut(roadWay, 'No way by the road is needed here.'),
  },
  {
    id: 'may-cross',
    label: 'It may go over what is in the way',
    keys: ['Alt+Enter'],
    icon: 'check',
    help: 'Over the median or kerb that the shown future crosses, for this goal alone',
    ...wayOut(leaveToCross, 'Nothing that could be crossed is in the way.'),
  },
  {
    id: 'generate',
    label: 'Generate',
    keys: ['Ctrl+Enter'],
    icon: 'play',
    help: 'Everybody worked out anew with this seed; new variants while their strip is open',
    context: 'always',
    when: hasScene,
    run: (c) => {
      if (c.variants.open.value) void c.variants.make();
      else c.generation.generateAll();
    },
  },
  {
    id: 'new-seed',
    label: 'New seed',
    keys: ['R'],
    icon: 'dice',
    help: 'Other futures for the same scene',
    when: hasScene,
    run: (c) => c.editor.run(setSeed(1 + Math.floor(Math.random() * LARGEST_NEW_SEED))),
  },
  {
    id: 'reset-agent',
    label: 'Reset to log',
    keys: ['Shift+R'],
    icon: 'undo',
    help: 'This road user as it was recorded',
    ...resetting,
  },
]);
