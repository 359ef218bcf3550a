// An action: one thing a user can do, with all that buttons, menus, palette and shortcut sheet show of it.
import type { Agent } from '../model/document/scene';
import { canChange, canMove } from '../model/document/scene';
import { freeOnes } from '../edit/moves/copying';
import type { Command } from '../model/document/commands';
import type { HandlePart } from '../edit/session/drag';
import type { Help } from '../texts/desk/helps';
import type { Context } from './context';
import { TEXTS } from '../texts/desk/actions';

/** In the order of the shortcut sheet. */
export const GROUPS = [
  'place',
  'select',
  'look',
  'edit',
  'move',
  'goal',
  'rounds',
  'time',
  'variants',
  'scene',
  'everything',
] as const;
export type Group = (typeof GROUPS)[number];

export interface Action {
  readonly id: string;
  readonly label: string;
  readonly group: Group;
  /** A description, in a table that loads after the buttons. */
  readonly help: Help;
  readonly keys?: readonly string[];
  readonly icon?: string;
  /** The browser handles its keys, and notifies the page by an event. */
  readonly native?: true;
  /** Where its keys work: everywhere, or only while no text field has the focus. */
  readonly context?: 'always';
  /** Its keys apply only while a handle is dragged; at other times they belong to another action. */
  readonly whileDragging?: true;
  /** Its keys apply only while it is offered, also in a drag; at other times they belong to another action. */
  onOffer?(c: Context): boolean;
  /** True when possible; otherwise the reason why not. */
  when?(c: Context): true | string;
  checked?(c: Context): boolean;
  run(c: Context): void;
}

/** The actions of one group. */
export const inGroup = (group: Group, actions: readonly Omit<Action, 'group'>[]): readonly Action[] =>
  actions.map((a) => ({ ...a, group }));

export const hasScene = (c: Context): true | string => (c.editor.isOpen.value ? true : TEXTS.noSceneIsOpen);

export const hasAgent = (c: Context): true | string => {
  const a = c.editor.restingAgent.value;
  return !a ? TEXTS.selectARoadUser : canChange(a) ? true : TEXTS.thisOneCanBe;
};

/** One road user is selected, and not locked. */
export const hasFree = (c: Context): true | string => {
  const can = hasAgent(c);
  return can !== true ? can : c.editor.restingAgent.value!.locked ? LOCKED : true;
};

const LOCKED = TEXTS.itIsLockedCtrl;

/** At least one is selected. */
export const hasSome = (c: Context): true | string => (c.editor.selected.value.length ? true : TEXTS.selectRoadUsers);

/** At least one of the selected may be moved and changed. */
export const hasSomeFree = (c: Context): true | string => {
  const all = c.editor.restingOnes;
  if (!all.length) return TEXTS.selectRoadUsers;
  if (all.some(canMove)) return true;
  return all.some((a) => a.locked) ? LOCKED : TEXTS.thisOneCanBe;
};

/** Runs a command on all selected road users that may be changed. */
export function onSome(make: (c: Context, all: readonly Agent[]) => Command | null): Pick<Action, 'when' | 'run'> {
  return {
    when: hasSomeFree,
    run(c) {
      const all = freeOnes(c.editor);
      const command = all.length ? make(c, all) : null;
      if (command) c.editor.commits.run(command);
    },
  };
}

/** The part that keys move. */
export const activePart = (c: Context): HandlePart => c.editor.focusPart.value;

/** Runs a command on the selected road user, when there is one and the command applies. */
export function onAgent(make: (c: Context, a: Agent) => Command | null): Pick<Action, 'when' | 'run'> {
  return {
    when: hasFree,
    run(c) {
      const a = c.editor.agent.value;
      const command = a && canMove(a) ? make(c, a) : null;
      if (command) c.editor.commits.run(command);
    },
  };
}
