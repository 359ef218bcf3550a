// A change of the document that was committed, as the parts of the page need it: what kind of change, and of whom.
import type { Way } from '../../model/document/scene-diff';
import { profileOf, type Agent, type Scene } from '../../model/document/scene';
import type { Commit } from './document';

/** A speed curve that a change put out of force: it still `fits` what is asked, or the new goal leaves it `open`. */
export type LostCurve = 'fits' | 'open';

export interface Step {
  readonly name: string;
  /** The road user that it is about, where it is one. */
  readonly agent: string | null;
  /** The road users that it is about, where they are several. */
  readonly several?: readonly string[];
  /** It was made by undo, redo, or a way through the history. */
  readonly undo: boolean;
  /** All road users are to be worked out anew. */
  readonly everybody?: boolean;
  /** The motions stand, only what counts in them is another thing. */
  readonly counting?: boolean;
  /** The seed or the diversity is another. */
  readonly chance?: boolean;
  /** The speed curve of its road user has gone out of force with it. */
  readonly curve?: LostCurve;
}

/** `way`: where one travelled in the history; null for a new step. `counting`: as in `Step`. */
export function stepOf({ before, after, name }: Commit, way: Way | 'there' | null, counting: boolean): Step {
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

/** Was nothing changed but the choice among the futures of a road user? */
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

/** What a change of a road user has done to its speed curve; null where nothing. */
function lostCurve(was: Agent | undefined, now: Agent | undefined): LostCurve | null {
  if (!was || !now?.profile || !profileOf(was) || profileOf(now)) return null;
  const [p, q] = [was.goal, now.goal];
  const sameGoal = p.pos === q.pos && p.heading === q.heading && p.speed === q.speed && p.time === q.time;
  const sameStart = was.start.pos === now.start.pos && was.start.heading === now.start.heading;
  return sameGoal && (sameStart || !q.pos) ? 'fits' : 'open';
}
