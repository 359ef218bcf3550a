// The bold future of a drag's last frame, for the generator: it is kept unless another is better by the cost of
// switching.
import type { ShownJson } from '../../model/document/scene-json';
import { isJudged } from '../../model/document/futures';
import type { Editor } from '../session/editor';

/** Box centres are sent every so many steps, this many at most. */
const EVERY = 5;
const MOST = 18;

/** The shown future of the selected road user; undefined where it did not come from the generator. */
export function shownFuture(
  e: Pick<Editor, 'reading' | 'selection'>,
  asked: readonly string[] | 'all',
): Record<string, ShownJson> | undefined {
  const id = e.selection.peek();
  const f = e.reading.futures.peek();
  const m = f?.modes[e.reading.chosen.peek()];
  if (!id || !f || !m || f.sketch || !isJudged(f) || asked === 'all' || !asked.includes(id)) return undefined;
  const x: number[] = [],
    y: number[] = [];
  for (let step = EVERY; step <= EVERY * MOST; step += EVERY) {
    const i = step - m.motion.first;
    if (i < 0 || i >= m.motion.x.length) break;
    x.push(round(m.motion.x[i]));
    y.push(round(m.motion.y[i]));
  }
  return { [id]: { ...(m.anchor == null ? {} : { anchor: m.anchor }), x_m: x, y_m: y } };
}

const round = (v: number): number => Math.round(v * 1000) / 1000;
