// Default pointer tools: select and drag, sweep, pan, and measure.
import { LASSO } from '../../gestures/lasso';
import { MEASURE } from '../../gestures/measuring';
import { PAN } from '../../gestures/panning';
import { SELECT } from '../../gestures/select';
import type { Feature } from '../feature';

const TOOLS = [SELECT, LASSO, PAN, MEASURE];

export const POINTING = { rail: TOOLS, make: () => ({ named: {}, tools: TOOLS }) } satisfies Feature;
