// Goal and futures: what is asked of the selected road user, which future it takes, and working everything out.
import { canChange, changedByHand, hasGoal, type Agent } from '../model/document/scene';
import { clearGoal, resetAgent, setSeed, type Command } from '../model/document/commands';
import { LETTERS } from '../model/document/futures';
import type { Editor } from '../edit/editor';
import * as moves from '../edit/moves';
import { pinnedAt, togglePin } from '../edit/pins';
import { leaveToCross, roadWay } from '../edit/ways-out';
import { clearGoals } from '../edit/several';
import { addVia, removeVia, roomForVia } from '../edit/vias';
import { activePart, hasFree, hasScene, hasSomeFree, inGroup, onAgent, onSome, type Action } from './action';
import type { Context } from './context';
import { TEXTS } from '../texts/desk/actions';
import { TEXTS as PINS } from '../texts/editing/pins';

const LARGEST_NEW_SEED = 9999;

const goalTime = (id: string, label: string, key: string, seconds: number): Omit<Action, 'group'> => ({
  id,
  label,
  keys: [key],
  help: 'timeAtTheGoal' as const,
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
  label: TEXTS.chooseFuture(letter),
  keys: [`Alt+${i + 1}`],
  help: 'playbackFollows' as const,
  ...onAgent((c, a) => {
    if (!c.rounds.isOpen.peek()) return moves.pickFuture(c.editor, a, i);
    c.rounds.take(i);
    return null;
  }),
}));

/** The future that a menu is about, or that is pointed at. */
const pointed = ({ editor, ui }: Context): number | null => ui.contextMenu.value?.future ?? editor.hoverFuture.value;

const onPointed = (run: (c: Context, a: Agent, i: number) => void): Pick<Action, 'when' | 'run'> => ({
  when: (c) => (pointed(c) === null ? TEXTS.pointAtAFuture : hasFree(c)),
  run(c) {
    const a = c.editor.agent.peek();
    const i = pointed(c);
    if (a && i !== null) run(c, a, i);
  },
});

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
  when: (c) => (c.editor.chosenOnes.some((a) => hasGoal(a.goal)) ? hasSomeFree(c) : TEXTS.noGoalIsSet),
};

const asRecorded: Pick<Action, 'when' | 'run'> = {
  ...onAgent((_, a) => moves.goalFromLog(a)),
  when: (c) => {
    const a = c.editor.agent.value;
    if (!a || a.locked) return hasFree(c);
    if (!moves.goalFromLog(a)) return TEXTS.nothingOfThatTime;
    return moves.isGoalOfLog(a) ? TEXTS.itsGoalIsThere : true;
  },
};

const resetting: Pick<Action, 'when' | 'run'> = {
  ...onAgent((_, a) => resetAgent(a)),
  when: (c) => {
    const a = c.editor.agent.value;
    if (!a || a.locked) return hasFree(c);
    return a.placed ? TEXTS.nothingOfItWas : changedByHand(a) ? true : TEXTS.itIsAsItWasRecorded;
  },
};

/** The future that is pointed at, else the one in force. */
const toPin = (c: Context): number => pointed(c) ?? c.editor.chosen.value;

const pinning: Pick<Action, 'when' | 'checked' | 'run'> = {
  when: (c) => {
    const free = hasFree(c);
    return free !== true || c.editor.futures.value ? free : TEXTS.itHasNoFutures;
  },
  checked: (c) => pinnedAt(c.editor, toPin(c)) !== null,
  run(c) {
    const a = c.editor.agent.peek();
    const done = a && togglePin(c.editor, a, toPin(c));
    if (typeof done === 'string') c.editor.notices.show({ text: done });
    else if (done) c.editor.run(done);
  },
};

export const goal = inGroup('goal', [
  {
    id: 'set-goal',
    label: TEXTS.setAGoal,
    keys: ['G'],
    icon: 'flag',
    help: 'whereTheChosen',
    ...onAgent((c, a) => {
      c.editor.activate('goal');
      return a.goal.pos ? null : moves.goalHere(c.editor, a);
    }),
  },
  {
    id: 'goal-from-log',
    label: TEXTS.goalAsInTheLog,
    keys: ['Alt+G'],
    icon: 'flag',
    help: 'whereItWasRecorded',
    ...asRecorded,
  },
  {
    id: 'clear-goal',
    label: TEXTS.clearTheGoal,
    keys: ['Shift+G'],
    icon: 'x',
    help: 'theGenerator',
    ...clearing,
  },
  {
    id: 'add-via',
    label: TEXTS.addAVia,
    keys: ['I'],
    icon: 'via',
    help: 'aPlaceToPass',
    when(c) {
      const a = c.editor.agent.value;
      const free = hasFree(c);
      if (free !== true || !a) return free;
      return c.editor.futures.value ? roomForVia(a) : TEXTS.itHasNoFutures;
    },
    run: (c) => putVia(c),
  },
  {
    id: 'remove-via',
    label: TEXTS.removeTheVia,
    keys: ['Del', 'Backspace'],
    icon: 'trash',
    help: 'theOneTakenLast',
    onOffer: (c) => viaInHand(c) !== null,
    when: (c) => (viaInHand(c) === null ? TEXTS.takeAViaFirst : hasFree(c)),
    run(c) {
      const found = viaInHand(c);
      const command = found && removeVia(found.a, found.i);
      if (command) c.editor.run(command);
    },
  },
  {
    id: 'toggle-field',
    label: TEXTS.fixedOrFree,
    keys: ['F'],
    icon: 'lock',
    help: 'theFieldTouched',
    ...onAgent(({ editor }, a) => {
      const { part, field } = editor.lastField.value;
      return moves.toggleField(editor, a, part, field);
    }),
  },
  {
    id: 'toggle-goal-speed',
    label: TEXTS.fixOrFreeThe,
    keys: ['Shift+F'],
    icon: 'lock',
    help: 'freeLetsThe',
    ...onAgent((c, a) => moves.toggleField(c.editor, a, 'goal', 'speed')),
  },
  {
    id: 'free-speed',
    label: TEXTS.speedFree,
    keys: ['Shift+Backspace'],
    help: 'speedOfThe',
    ...onAgent((c, a) => {
      const part = activePart(c);
      return a[part].speed === null ? null : moves.toggleField(c.editor, a, part, 'speed');
    }),
  },
  goalTime('goal-earlier', TEXTS.goal01SEarlier, ';', -0.1),
  goalTime('goal-later', TEXTS.goal01SLater, "'", 0.1),
  goalTime('goal-earlier-far', TEXTS.goal1SEarlier, 'Shift+;', -1),
  goalTime('goal-later-far', TEXTS.goal1SLater, "Shift+'", 1),
  ...futures,
  {
    id: 'future-choose',
    label: TEXTS.chooseThisFuture,
    icon: 'check',
    help: 'playbackFollowsIt',
    ...onPointed((c, a, i) => moves.takeFuture(c.editor, a, i)),
  },
  {
    id: 'future-play',
    label: TEXTS.chooseAndPlay,
    icon: 'play',
    help: 'fromTheBeginning',
    ...onPointed((c, a, i) => {
      moves.takeFuture(c.editor, a, i);
      c.editor.setTime(0);
      c.editor.playhead.play();
    }),
  },
  {
    id: 'future-compare',
    label: TEXTS.compareAllSide,
    icon: 'compare',
    help: 'eachFuture',
    ...onPointed((c) => {
      c.variants.show(true);
      void c.variants.make();
    }),
  },
  {
    id: 'future-pin',
    label: PINS.pin,
    keys: ['Shift+P'],
    icon: 'pin',
    help: 'itStaysWhile',
    ...pinning,
  },
  {
    id: 'future-best',
    label: TEXTS.backToTheMost,
    keys: ['Alt+0'],
    help: 'theGeneratorChooses',
    ...onAgent((c, a) => (a.chosen === null ? null : moves.pickFuture(c.editor, a, null))),
  },
  {
    id: 'by-road',
    label: TEXTS.takeTheWayBy,
    keys: ['Enter'],
    icon: 'road',
    help: 'theNearest',
    ...wayOut(roadWay, TEXTS.noWayByTheRoad),
  },
  {
    id: 'may-cross',
    label: TEXTS.itMayGoOverWhat,
    keys: ['Alt+Enter'],
    icon: 'check',
    help: 'overTheMedian',
    ...wayOut(leaveToCross, TEXTS.nothingThatCould),
  },
  {
    id: 'generate',
    label: TEXTS.generate,
    keys: ['Ctrl+Enter'],
    icon: 'play',
    help: 'everybodyWorked',
    context: 'always',
    when: hasScene,
    run: (c) => {
      if (c.variants.open.value) void c.variants.make();
      else c.generation.generateAll();
    },
  },
  {
    id: 'new-seed',
    label: TEXTS.newSeed,
    keys: ['R'],
    icon: 'dice',
    help: 'otherFutures',
    when: hasScene,
    run: (c) => c.editor.run(setSeed(1 + Math.floor(Math.random() * LARGEST_NEW_SEED))),
  },
  {
    id: 'reset-agent',
    label: TEXTS.resetToLog,
    keys: ['Shift+R'],
    icon: 'undo',
    help: 'thisRoadUser',
    ...resetting,
  },
]);
