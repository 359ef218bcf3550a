// A committed change of the document, as parts of the page need it: its kind, and the changed road users.
import type { HistoryDirection } from '../../model/document/scene-diff';
import { profileOf, type Agent, type Scene } from '../../model/document/scene';
import type { Commit } from './document';

/** A speed curve put out of force by a change: it still `fits` the conditions, or the new goal leaves it `open`. */
export type LostCurve = 'fits' | 'open';

export interface Step {
  readonly name: string;
  /** The changed road user, where it is one. */
  readonly agent: string | null;
  /** The changed road users, where they are several. */
  readonly several?: readonly string[];
  /** True for undo, redo, or a jump in the history. */
  readonly undo: boolean;
  /** All road users are to be computed again. */
  readonly everybody?: boolean;
  /** The motions stay; only the thresholds or what is counted changed. */
  readonly counting?: boolean;
  /** The seed or the diversity changed. */
  readonly chance?: boolean;
  /** The change put the speed curve of its road user out of force. */
  readonly curve?: LostCurve;
}

/** `way`: direction in the history; null for a new step. `counting`: as in `Step`. */
export function stepOf(
  { before, after, name }: Commit,
  way: HistoryDirection | 'there' | null,
  counting: boolean,
): Step {
  const undo = way !== null;
  const changed = changedAgents(before, after);
  const agent = changed.length === 1 ? changed[0] : null;
  const everybody = undo ? after.drawn > 0 : after.drawn > before.drawn;
  const curve = agent === null || undo ? null : lostCurve(before.agents.get(agent), after.agents.get(agent));
  return {
    ...{ name, agent, several: changed.length > 1 ? changed : undefined, undo },
    ...(curve ? { curve } : {}),
    ...(everybody && !counting ? { everybody } : {}),
    ...(counting ? { counting } : {}),
    ...(before.seed !== after.seed || before.diversity !== after.diversity ? { chance: true } : {}),
  };
}

/** Did the step change only the choice among the futures of a road user? */
export function onlyPicked({ before, after }: Commit, id: string): boolean {
  const a = before.agents.get(id),
    b = after.agents.get(id);
  return (
    !!a &&
    !!b &&
    a.start === b.start &&
    a.goal === b.goal &&
    a.length === b.length &&
    a.width === b.width &&
    a.does === b.does &&
    (a.chosen !== b.chosen || a.dealt !== b.dealt) &&
    before.castKey === after.castKey &&
    before.seed === after.seed &&
    before.diversity === after.diversity &&
    before.others === after.others &&
    before.length === after.length &&
    before.replan === after.replan
  );
}

function changedAgents(before: Scene, after: Scene): string[] {
  const gone = [...before.agents.keys()].filter((id) => !after.agents.has(id));
  return [...[...after.agents].filter(([id, a]) => before.agents.get(id) !== a).map(([id]) => id), ...gone];
}

/** Effect of a change on the speed curve of its road user; null where there is none. */
function lostCurve(was: Agent | undefined, now: Agent | undefined): LostCurve | null {
  if (!was || !now?.profile || !profileOf(was) || profileOf(now)) return null;
  const [p, q] = [was.goal, now.goal];
  const sameGoal = p.pos === q.pos && p.heading === q.heading && p.speed === q.speed && p.time === q.time;
  const sameStart = was.start.pos === now.start.pos && was.start.heading === now.start.heading;
  return sameGoal && (sameStart || !q.pos) ? 'fits' : 'open';
}
