// Titles of the arms of a map or a junction, by the compass point in which they lie.
import { TEXTS } from '../../texts/scene/places';

const POINTS = [
  TEXTS.arms.east,
  TEXTS.arms.northEast,
  TEXTS.arms.north,
  TEXTS.arms.northWest,
  TEXTS.arms.west,
  TEXTS.arms.southWest,
  TEXTS.arms.south,
  TEXTS.arms.southEast,
] as const;

/** The nearest of eight compass points, counter-clockwise from east. Halves go away from zero, as on the server. */
function pointOf(angleDeg: number): number {
  const eighths = Math.sign(angleDeg) * Math.round(Math.abs(angleDeg) / 45);
  return ((eighths % 8) + 8) % 8;
}

/**
 * `North`, or `North-west 2` where several arms lie in the same direction, in the order of the arms. Angles are
 * counter-clockwise from east, degrees.
 */
export function armTitles(anglesDeg: readonly number[]): string[] {
  const points = anglesDeg.map(pointOf);
  return points.map((point, i) => {
    const several = points.filter((p) => p === point).length > 1;
    const number = points.slice(0, i + 1).filter((p) => p === point).length;
    return several ? `${POINTS[point]} ${number}` : POINTS[point];
  });
}
