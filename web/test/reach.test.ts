// The part of a canvas that is cleared holds whatever was painted: else trails stay.
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { both, NOTHING, reachOf, within, type Part } from '../src/draw/reach';
import { Shape } from '../src/draw/pen';
import { Recording, Vocabulary } from '../src/draw/recording';

const number = fc.integer({ min: -500, max: 500 });
const steps = fc.array(
  fc.oneof(
    fc.record({ kind: fc.constant('move' as const), x: number, y: number }),
    fc.record({ kind: fc.constant('turn' as const), x: number }),
    fc.record({ kind: fc.constant('save' as const) }),
    fc.record({ kind: fc.constant('restore' as const) }),
    fc.record({ kind: fc.constant('line' as const), x: number, y: number }),
    fc.record({ kind: fc.constant('box' as const), x: number, y: number }),
  ),
  { maxLength: 40 },
);

type Steps = typeof steps extends fc.Arbitrary<infer T> ? T : never;

/** The recording of such steps, and the places on the canvas that they paint, worked out by themselves. */
function painted(all: Steps, dpr: number): { ops: Float64Array; places: [number, number][] } {
  const pen = new Recording(new Vocabulary());
  const places: [number, number][] = [];
  const kept: number[][] = [];
  // Where the pen's origin lies, how it is turned.
  let [ox, oy, turned] = [0, 0, 0];
  const at = (x: number, y: number): [number, number] => [
    dpr * (ox + x * Math.cos(turned) - y * Math.sin(turned)),
    dpr * (oy + x * Math.sin(turned) + y * Math.cos(turned)),
  ];
  for (const step of all)
    switch (step.kind) {
      case 'move':
        pen.translate(step.x, step.y);
        [ox, oy] = at(step.x, step.y).map((v) => v / dpr);
        break;
      case 'turn':
        pen.rotate(step.x / 50);
        turned += step.x / 50;
        break;
      case 'save':
        pen.save();
        kept.push([ox, oy, turned]);
        break;
      case 'restore':
        pen.restore();
        [ox, oy, turned] = kept.pop() ?? [ox, oy, turned];
        break;
      case 'line':
        pen.beginPath();
        pen.moveTo(0, 0);
        pen.lineTo(step.x, step.y);
        pen.stroke();
        places.push(at(0, 0), at(step.x, step.y));
        break;
      case 'box':
        pen.fillRect(step.x, step.y, 30, 20);
        places.push(at(step.x, step.y), at(step.x + 30, step.y + 20), at(step.x + 30, step.y));
    }
  return { ops: pen.take(), places };
}

const holds = (part: Part, [x, y]: [number, number]): boolean =>
  x >= part.x0 - 1e-6 && x <= part.x1 + 1e-6 && y >= part.y0 - 1e-6 && y <= part.y1 + 1e-6;

describe('how far a recording reaches', () => {
  it('holds every place that is painted, however the pen was moved and turned', () => {
    fc.assert(
      fc.property(steps, fc.constantFrom(1, 1.5, 2), (all, dpr) => {
        const { ops, places } = painted(all, dpr);
        const reach = reachOf(ops, { texts: [], shapes: [] }, dpr);
        expect(places.every((place) => holds(reach, place))).toBe(true);
        if (!places.length) expect(reach).toEqual(NOTHING);
      }),
    );
  });

  it('is little more than what is painted', () => {
    const words = new Vocabulary();
    const pen = new Recording(words);
    pen.lineJoin = 'round';
    pen.lineWidth = 4;
    pen.beginPath();
    pen.moveTo(100, 100);
    pen.lineTo(160, 120);
    pen.stroke();
    const sizes = { texts: words.news().texts, shapes: [] };
    expect(reachOf(pen.take(), sizes, 1)).toEqual({ x0: 95, y0: 95, x1: 165, y1: 125 });
  });

  it('knows texts, shapes and shadows', () => {
    const words = new Vocabulary();
    const pen = new Recording(words);
    const shape = new Shape();
    shape.add(
      [
        [10, 20],
        [40, 25],
      ],
      false,
    );
    pen.setTransform(2, 0, 0, -2, 100, 100);
    pen.fillShape(shape, 'nonzero');
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.font = '600 10px Inter';
    pen.shadowBlur = 6;
    pen.shadowOffsetY = 4;
    pen.fillText('abc', 300, 300);
    const sizes = { texts: words.news().texts, shapes: [{ x0: 10, y0: 20, x1: 40, y1: 25 }] };
    const reach = reachOf(pen.take(), sizes, 1);
    for (const place of [
      [120, 60],
      [180, 50],
      [300, 290],
      [318, 300],
      [300, 306],
    ] as [number, number][])
      expect(holds(reach, place)).toBe(true);
    expect(within(both(reach, NOTHING), 200, 200)).toEqual({ x0: 118, y0: 48, x1: 200, y1: 200 });
  });
});
