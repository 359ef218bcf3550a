// Which preferences are sure enough to be named first.
import type { Wished } from '../../edit/tools/rounds/rounds';

/** Below this strength a few answers agree by chance, as on 27 against 28 km/h. */
const LEAST_STRENGTH = 0.25;

/** Set by the user, or learned with some strength. */
export const isSure = ({ learned }: Wished): boolean => !learned || learned.said || learned.strength >= LEAST_STRENGTH;
