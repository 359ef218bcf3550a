// The single list of all actions: the groups in the order of the shortcut sheet. Menus, buttons, palette, shortcut
// sheet and tooltips are made from it.
import type { Action } from './action';
import type { Context } from './context';
import { cases } from './cases';
import { edit } from './edit';
import { everything } from './everything';
import { goal } from './goal';
import { look } from './look';
import { movement } from './move';
import { place } from './place';
import { rounds } from './rounds';
import { scene } from './scene';
import { time } from './time';
import { variants } from './variants';

export const ACTIONS: readonly Action[] = Object.freeze(
  [rounds, look, place, edit, movement, goal, time, variants, cases, scene, everything].flat(),
);

const byId = new Map(ACTIONS.map((a) => [a.id, a]));
const keysOf = (actions: readonly Action[]): ReadonlyMap<string, Action> =>
  new Map(actions.flatMap((a) => (a.keys ?? []).map((k) => [k, a] as const)));
const byKey = keysOf(ACTIONS.filter((a) => !a.whileDragging && !a.onOffer));
const byKeyWhileDragging = keysOf(ACTIONS.filter((a) => a.whileDragging));

export function actionOf(id: string): Action {
  const a = byId.get(id);
  if (!a) throw new Error(`no action ${id}`);
  return a;
}

const onOffer = ACTIONS.filter((a) => a.onOffer);

interface Now {
  readonly dragging?: boolean;
  offers?(a: Action): boolean;
}

/** The action of a key, by the current state. */
export function actionForKey(key: string, { dragging = false, offers }: Now = {}): Action | undefined {
  const offered = offers && onOffer.find((a) => a.keys?.includes(key) && offers(a));
  if (offered) return offered;
  return (dragging ? byKeyWhileDragging.get(key) : undefined) ?? byKey.get(key);
}

/** The action that a key has while it is offered; for a key that now has none. */
export const offeredElsewhere = (key: string): Action | undefined => onOffer.find((a) => a.keys?.includes(key));

export const possible = (c: Context, a: Action): true | string => a.when?.(c) ?? true;

export function perform(c: Context, id: string): void {
  const a = actionOf(id);
  const can = possible(c, a);
  if (can === true) a.run(c);
  else c.editor.notices.refuse(can);
}
