// A line drawn round road users selects them.
import type { Vec } from '../../model/base/geometry';
import type { Chart, State } from './chart';
import type { Press } from './pressed';
import { click } from './select';
import { Sweeping } from './sweeping';
import { TEXTS } from '../../texts/desk/gestures';

/** The line takes a further point after so many metres; it has this many at most. */
const STEP_M = 0.3;
const MOST_POINTS = 2000;

function longer(from: Vec, to: Vec, before: readonly Vec[]): readonly Vec[] {
  const last = before.at(-1);
  if (!last) return [from, to];
  if (Math.hypot(to[0] - last[0], to[1] - last[1]) < STEP_M || before.length >= MOST_POINTS) return before;
  return [...before, to];
}

export const LASSO = {
  name: 'lasso' as const,
  label: TEXTS.lasso,
  key: 'L',
  icon: 'lasso',
  help: 'drawALineRound' as const,
  cursor: 'crosshair',
  picks: true,
  drag: (chart: Chart, press: Press): State => new Sweeping('lasso', chart, press, longer),
  click,
};
