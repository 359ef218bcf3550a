// Lines of the futures of a road user: their widths say which one is in force, and how likely the others are.
import { afterAll, beforeAll, describe, expect, it, vi } from 'vitest';
import { choose } from '../../src/model/document/commands';
import { unnamedFutures } from '../../src/model/document/futures';
import { SvgPen } from '../../src/draw/svg-pen';
import { paintFutures } from '../../src/draw/strokes';
import { modeColour, readPalette } from '../../src/draw/theme';
import { View } from '../../src/draw/view';
import { finalOf, Session, six } from '../edit/session';
import { car, crossing } from '../helpers';

/** Probabilities from a third to a fiftieth. */
const SHARES = [0.34, 0.24, 0.18, 0.13, 0.09, 0.02];

// Every colour is called by its name.
beforeAll(() => {
  vi.stubGlobal('document', { documentElement: null });
  vi.stubGlobal('getComputedStyle', () => ({ getPropertyValue: (name: string) => name }));
  readPalette();
});
afterAll(() => vi.unstubAllGlobals());

/** Width of each future's line, pixels; halos and dots are not counted. */
function widths(chosen: number): number[] {
  const answer = six(car(crossing()).id);
  const modes = answer.modes.map((mode, i) => ({ ...mode, probability: SHARES[i] }));
  const futures = unnamedFutures({ ...answer, modes }, null, 5, 5);
  expect(futures.modes.map((m) => m.probability)).toEqual(SHARES);
  const pen = new SvgPen();
  paintFutures(pen, Object.assign(new View(), { w: 800, h: 600 }), futures, { chosen });
  const drawn = pen.take();
  return SHARES.map((_, i) => {
    const [width, ...rest] = [...drawn.matchAll(new RegExp(`<path [^>]*stroke="${modeColour(i)}"[^>]*>`, 'g'))].map(
      ([line]) => Number(/stroke-width="([\d.]+)"/.exec(line)![1]),
    );
    expect(rest).toEqual([]);
    return width;
  });
}

describe('lines of futures', () => {
  it('are equally wide while none is marked, whatever their probabilities', () => {
    const all = widths(-1);
    expect(new Set(all).size).toBe(1);
    expect(all[0]).toBeGreaterThan(1);
  });

  it('mark none of a road user that replays its recording, and the chosen one of any other', () => {
    const { editor, generator } = new Session();
    editor.select('1');
    generator.last.on.final(finalOf('1'), 5);
    expect(editor.reading.futures.peek()!.modes).toHaveLength(6);
    expect(editor.reading.bold.peek()).toBe(-1);
    editor.commits.run(choose(editor.agent.peek()!, 2, 'C'));
    expect(editor.reading.bold.peek()).toBe(2);
  });

  it('are widest for the marked one, and wider for a likelier one of the rest', () => {
    const all = widths(3);
    const rest = all.filter((_, i) => i !== 3);
    expect(rest).toEqual(rest.toSorted((a, b) => b - a));
    expect(new Set(rest).size).toBe(rest.length);
    expect(all[3]).toBeGreaterThan(widths(0)[3]);
  });
});
