// Futures with a speed profile drawn by the user.
import { limitsOf } from '../../model/base/domain';
import type { Futures, Score } from '../../model/document/futures';
import type { Profile } from '../../model/document/profile';
import { profileOf, type Agent, type Scene } from '../../model/document/scene';
import { motionOf } from '../../model/physics/speed-profile';
import { judgedBy } from '../../model/physics/verdict-updates';
import { TEXTS } from '../../texts/editing/moves';

/** Name of a future with a speed profile drawn by the user. */
const OWN_SPEED = TEXTS.atYourSpeed;

/** Futures of which the chosen one follows a drawn profile; its verdict no longer holds and is removed. */
export function withCurve(f: Futures, chosen: number, profile: Profile, a: Agent, duration: number): Futures {
  const motion = motionOf(profile, limitsOf(a), duration);
  const modes = f.modes.map((m, i) =>
    i === chosen ? { ...m, motion, name: OWN_SPEED, about: null, sent: undefined } : m,
  );
  return { ...f, modes };
}

/** The futures of a scene, with drawn speed profiles applied. */
export function withCurves(scene: Scene, futures: ReadonlyMap<string, Futures>): ReadonlyMap<string, Futures> {
  const drawn = [...scene.agents.values()].filter((a) => profileOf(a) && futures.has(a.id));
  if (!drawn.length) return futures;
  const out = new Map(futures);
  for (const a of drawn) out.set(a.id, withCurve(futures.get(a.id)!, a.chosen!, profileOf(a)!, a, scene.duration));
  return out;
}

/** The same, judged by the score of the scene. */
export function judgedCurves(
  scene: Scene,
  futures: ReadonlyMap<string, Futures>,
  score: Score,
): ReadonlyMap<string, Futures> {
  const drawn = [...scene.agents.values()].filter((a) => profileOf(a) && futures.has(a.id));
  if (!drawn.length) return futures;
  const out = new Map(futures);
  for (const a of drawn) {
    const f = out.get(a.id)!;
    out.set(a.id, { ...f, modes: f.modes.map((m, i) => (i === a.chosen ? judgedBy(score, a, m) : m)) });
  }
  return out;
}
