// An action: one thing a user can do, with everything that buttons, menus, palette and shortcut sheet say of it.
import type { Agent } from '../model/scene';
import { canChange } from '../model/scene';
import type { Command } from '../model/commands';
import type { Part } from '../edit/editor';
import type { Context } from './context';

/** In the order of the shortcut sheet. */
export const GROUPS = ['Select and look', 'Move', 'Goal and futures', 'Time', 'Scene', 'Everything'] as const;
export type Group = (typeof GROUPS)[number];

export interface Action {
  readonly id: string;
  readonly label: string;
  readonly group: Group;
  readonly help: string;
  readonly keys?: readonly string[];
  readonly icon?: string;
  /** Where its keys work: everywhere, or only while no text field has the focus. */
  readonly context?: 'always';
  /** Its keys are its own while a handle is dragged; at other times they are another action's. */
  readonly whileDragging?: true;
  /** Its keys are its own while it is on offer, also in a drag; at other times they are another action's. */
  onOffer?(c: Context): boolean;
  /** True when possible; words say why not. */
  when?(c: Context): true | string;
  checked?(c: Context): boolean;
  run(c: Context): void;
}

/** The actions of one group. */
export const inGroup = (group: Group, actions: readonly Omit<Action, 'group'>[]): readonly Action[] =>
  actions.map((a) => ({ ...a, group }));

export const hasScene = (c: Context): true | string => (c.editor.scene.value ? true : 'No scene is open.');

export const hasAgent = (c: Context): true | string => {
  const a = c.editor.agent.value;
  return !a ? 'Select a road user first.' : canChange(a) ? true : 'This one can be looked at, not changed.';
};

/** The part that keys move. */
export const activePart = (c: Context): Part => c.editor.focusPart.value;

/** Does a command on the selected road user, when there is one and the command makes sense. */
export function onAgent(make: (c: Context, a: Agent) => Command | null): Pick<Action, 'when' | 'run'> {
  return {
    when: hasAgent,
    run(c) {
      const a = c.editor.agent.value;
      const command = a && canChange(a) ? make(c, a) : null;
      if (command) c.editor.run(command);
    },
  };
}
