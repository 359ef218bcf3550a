// Space for road users: what occupies a place, and where there is room instead.
import { limitsOf } from '../../model/base/domain';
import { touching, type Footprint } from '../../model/physics/boxes';
import type { Pose, Vec } from '../../model/base/geometry';
import type { Newcomer } from '../../model/document/newcomer';
import { startPose, type Agent, type Scene } from '../../model/document/scene';

/** Boxes of all road users present at the start of a scene. */
export function standing(scene: Scene): (Footprint & { readonly agent: Agent; readonly pose: Pose })[] {
  return [...scene.agents.values()].flatMap((agent) => {
    const pose = startPose(agent);
    return pose ? [{ agent, pose, length: agent.length, width: agent.width }] : [];
  });
}

/** The same, each with the way ahead that it needs to stop: several road users put there at once would be hit. */
export const stopping = (scene: Scene): Footprint[] =>
  standing(scene).map(({ agent, pose, length, width }) => {
    const way = pose.speed ** 2 / (2 * limitsOf(agent).hurried.brake_mps2);
    const { x, y, heading } = pose;
    const middle = { x: x + (way / 2) * Math.cos(heading), y: y + (way / 2) * Math.sin(heading), heading };
    return { pose: middle, length: length + way, width };
  });

/** The box that overlaps this one. */
export const inTheWay = (f: Footprint, taken: readonly Footprint[]): Footprint | undefined =>
  taken.find((o) => touching(f, o));

/** Range of the search for a free place, metres. */
const LOOK_M = 60;

/**
 * The shift that frees all of them from overlaps: the nearest place behind the first of them, before it, or beside it.
 * Null where all is full.
 */
export function freeShift(all: readonly Newcomer[], taken: readonly Footprint[], step = 2): Vec | null {
  const first = all[0];
  if (!first) return null;
  const h = first.pose.heading;
  const fits = (dx: number, dy: number): boolean =>
    all.every((n) => !inTheWay({ ...n, pose: { ...n.pose, x: n.pose.x + dx, y: n.pose.y + dy } }, taken));
  if (fits(0, 0)) return [0, 0];
  for (let d = step; d <= LOOK_M; d += step)
    for (const turn of [Math.PI, 0, -Math.PI / 2, Math.PI / 2, (-3 * Math.PI) / 4, (3 * Math.PI) / 4]) {
      const dx = Math.cos(h + turn) * d,
        dy = Math.sin(h + turn) * d;
      if (fits(dx, dy)) return [dx, dy];
    }
  return null;
}
