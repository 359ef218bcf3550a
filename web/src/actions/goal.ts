// Goal and futures: conditions of the selected road user, the followed future, and generating all.
import { canChange, changedByHand, hasGoal, type Agent } from '../model/document/scene';
import { clearGoal, resetAgent, setSeed, type Command } from '../model/document/commands';
import { LETTERS } from '../model/document/futures';
import type { Editor } from '../edit/session/editor';
import * as moves from '../edit/moves/moves';
import { pinnedAt, togglePin } from '../edit/moves/pins';
import { leaveToCross, roadWay } from '../edit/moves/ways-out';
import { clearGoals } from '../edit/moves/several';
import { addVia, removeVia, roomForVia } from '../edit/moves/vias';
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

/** A remedy for a goal that is reached by breaking rules; during a drag it ends the drag. */
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
      if (c.editor.drag.active.peek()) c.gestures.cancel();
      if (way) c.editor.commits.run(way.command);
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

/** The future of the menu, or under the pointer. */
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

/** At the place of the menu or pointer on a future; else half way along the followed one. */
function putVia(c: Context): void {
  const { editor, ui, gestures, stage } = c;
  const a = editor.agent.peek();
  if (!a) return;
  const future = pointed(c);
  const at = ui.contextMenu.peek() ?? gestures.pointer;
  const near = future !== null && at ? stage.view.from(at.x, at.y) : null;
  const added = addVia(editor, a, near, future ?? undefined);
  if (!added) return;
  editor.commits.run(added.command);
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
    return moves.isGoalOfLog(a) ? TEXTS.goalIsAsRecorded : true;
  },
};

const resetting: Pick<Action, 'when' | 'run'> = {
  ...onAgent((_, a) => resetAgent(a)),
  when: (c) => {
    const a = c.editor.agent.value;
    if (!a || a.locked) return hasFree(c);
    return a.placed ? TEXTS.notRecorded : changedByHand(a) ? true : TEXTS.itIsAsItWasRecorded;
  },
};

/** The future under the pointer, else the followed one. */
const toPin = (c: Context): number => pointed(c) ?? c.editor.reading.chosen.value;

const pinning: Pick<Action, 'when' | 'checked' | 'run'> = {
  when: (c) => {
    const free = hasFree(c);
    return free !== true || c.editor.reading.futures.value ? free : TEXTS.itHasNoFutures;
  },
  checked: (c) => pinnedAt(c.editor, toPin(c)) !== null,
  run(c) {
    const a = c.editor.agent.peek();
    const done = a && togglePin(c.editor, a, toPin(c));
    if (typeof done === 'string') c.editor.notices.show({ text: done });
    else if (done) c.editor.commits.run(done);
  },
};

export const goal = inGroup('goal', [
  {
    id: 'set-goal',
    label: TEXTS.setAGoal,
    keys: ['G'],
    icon: 'flag',
    help: 'endOfTheChosenFuture',
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
    help: 'theRecordedPosition',
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
    help: 'aPlaceOnThePath',
    when(c) {
      const a = c.editor.agent.value;
      const free = hasFree(c);
      if (free !== true || !a) return free;
      return c.editor.reading.futures.value ? roomForVia(a) : TEXTS.itHasNoFutures;
    },
    run: (c) => putVia(c),
  },
  {
    id: 'remove-via',
    label: TEXTS.removeTheVia,
    keys: ['Del', 'Backspace'],
    icon: 'trash',
    help: 'theViaPointSelectedLast',
    onOffer: (c) => viaInHand(c) !== null,
    when: (c) => (viaInHand(c) === null ? TEXTS.selectAViaPoint : hasFree(c)),
    run(c) {
      const found = viaInHand(c);
      const command = found && removeVia(found.a, found.i);
      if (command) c.editor.commits.run(command);
    },
  },
  {
    id: 'toggle-field',
    label: TEXTS.fixedOrFree,
    keys: ['F'],
    icon: 'lock',
    help: 'theFieldEditedLast',
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
    help: 'ifFree',
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
    help: 'playsFromTheStart',
    ...onPointed((c, a, i) => {
      moves.takeFuture(c.editor, a, i);
      c.editor.playhead.moveTo(0);
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
    help: 'undoesTheChoice',
    ...onAgent((c, a) => (a.chosen === null ? null : moves.pickFuture(c.editor, a, null))),
  },
  {
    id: 'by-road',
    label: TEXTS.useTheRouteByRoad,
    keys: ['Enter'],
    icon: 'road',
    help: 'theNearest',
    ...wayOut(roadWay, TEXTS.noRouteByRoad),
  },
  {
    id: 'hold-gap',
    label: TEXTS.keepTheGap,
    keys: ['Shift+Enter'],
    help: 'theGoalIsThenRelative',
    onOffer: (c: Context) => c.gapOffer.now.value !== null,
    when: (c: Context) => (c.gapOffer.now.value ? true : TEXTS.noGapToKeep),
    run: (c: Context) => c.gapOffer.accept(),
  },
  {
    id: 'may-cross',
    label: TEXTS.allowCrossing,
    keys: ['Alt+Enter'],
    icon: 'check',
    help: 'forThisGoalOnly',
    ...wayOut(leaveToCross, TEXTS.noKerbOrMedian),
  },
  {
    id: 'generate',
    label: TEXTS.generate,
    keys: ['Ctrl+Enter'],
    icon: 'play',
    help: 'computesAll',
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
    run: (c) => c.editor.commits.run(setSeed(1 + Math.floor(Math.random() * LARGEST_NEW_SEED))),
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
