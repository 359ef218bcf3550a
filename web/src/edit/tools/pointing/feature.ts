// What the pointer does by itself: it selects and drags, goes round, moves the picture, and measures.
import { LASSO } from '../../gestures/lasso';
import { MEASURE } from '../../gestures/measuring';
import { PAN } from '../../gestures/panning';
import { SELECT } from '../../gestures/select';
import type { Feature } from '../feature';

const TOOLS = [SELECT, LASSO, PAN, MEASURE];

export const POINTING = { rail: TOOLS, make: () => ({ named: {}, tools: TOOLS }) } satisfies Feature;
