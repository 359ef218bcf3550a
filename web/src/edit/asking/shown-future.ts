// The future that was bold last, for the generator: it leaves it only for a gain that is worth the jump.
import type { ShownJson } from '../../model/document/scene-json';
import { isJudged } from '../../model/document/futures';
import type { Editor } from '../session/editor';

/** Box centres are sent every so many steps, this many at most. */
const EVERY = 5;
const MOST = 18;

/** What is on screen of the selected road user; nothing where none of it came from the generator. */
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
