// The extent of a recording contains all painted places, and is not much larger.
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { Extent } from '../../src/draw/recording/extent';

const SIZE = { w: 400, h: 300 };
const coordinate = fc.double({ min: -50, max: 350, noNaN: true });
const length = fc.double({ min: 0, max: 60, noNaN: true });
const angle = fc.double({ min: -7, max: 7, noNaN: true });
const move = fc.oneof(
  fc.record({ kind: fc.constant('translate' as const), x: coordinate, y: coordinate }),
  fc.record({ kind: fc.constant('rotate' as const), angle }),
  fc.record({ kind: fc.constant('save' as const) }),
  fc.record({ kind: fc.constant('restore' as const) }),
);
const shape = fc.oneof(
  fc.record({
    kind: fc.constant('line' as const),
    x: coordinate,
    y: coordinate,
    dx: length,
    dy: length,
    width: length,
  }),
  fc.record({ kind: fc.constant('box' as const), x: coordinate, y: coordinate, w: length, h: length }),
  fc.record({ kind: fc.constant('disc' as const), x: coordinate, y: coordinate, r: length }),
  fc.record({ kind: fc.constant('curve' as const), x: coordinate, y: coordinate, dx: length, dy: length }),
);
type Point = [number, number];
/** Places that are certainly painted. */
function samples(s: typeof shape extends fc.Arbitrary<infer T> ? T : never): Point[] {
  const steps = Array.from({ length: 17 }, (_, i) => i / 16);
  switch (s.kind) {
    case 'line': {
      const l = Math.hypot(s.dx, s.dy) || 1;
      const aside = [-s.width / 2, 0, s.width / 2];
      if (!s.dx && !s.dy) return [];
      return steps.flatMap((k) =>
        aside.map((a): Point => [s.x + k * s.dx - (a * s.dy) / l, s.y + k * s.dy + (a * s.dx) / l]),
      );
    }
    case 'box':
      return steps.flatMap((k) => [0, 1].map((j): Point => [s.x + k * s.w, s.y + j * s.h]));
    case 'disc':
      return steps.map((k) => [s.x + s.r * Math.cos(2 * Math.PI * k), s.y + s.r * Math.sin(2 * Math.PI * k)]);
    case 'curve':
      // From (x, y) by (x + dx, y) to (x + dx, y + dy).
      return steps.map((k) => [s.x + s.dx * (2 * k * (1 - k) + k * k), s.y + s.dy * k * k]);
  }
}

const extent = (scale: number) => new Extent(scale, () => ({ left: 10, top: 20, right: 30, bottom: 40 }));

describe('the extent of a recording', () => {
  it('contains every painted place', () => {
    fc.assert(
      fc.property(fc.constantFrom(1, 2), fc.array(fc.oneof(move, shape), { maxLength: 25 }), (scale, all) => {
        const e = extent(scale);
        let now = new Matrix(scale, 0, 0, scale, 0, 0);
        const saved: Matrix[] = [];
        const painted: Point[] = [];
        for (const one of all) {
          if (one.kind === 'translate') {
            e.translate(one.x, one.y);
            now = now.times(new Matrix(1, 0, 0, 1, one.x, one.y));
          } else if (one.kind === 'rotate') {
            e.rotate(one.angle);
            const [cos, sin] = [Math.cos(one.angle), Math.sin(one.angle)];
            now = now.times(new Matrix(cos, sin, -sin, cos, 0, 0));
          } else if (one.kind === 'save') {
            e.save();
            saved.push(now);
          } else if (one.kind === 'restore') {
            e.restore();
            now = saved.pop() ?? now;
          } else {
            e.beginPath();
            if (one.kind === 'line') {
              e.lineWidth = one.width || 1;
              e.moveTo(one.x, one.y);
              e.lineTo(one.x + one.dx, one.y + one.dy);
              e.stroke();
            } else if (one.kind === 'box') e.fillRect(one.x, one.y, one.w, one.h);
            else if (one.kind === 'disc') {
              e.arc(one.x, one.y, one.r);
              e.fill();
            } else {
              e.moveTo(one.x, one.y);
              e.quadraticCurveTo(one.x + one.dx, one.y, one.x + one.dx, one.y + one.dy);
              e.fill();
            }
            painted.push(...samples(one).map((p) => now.to(p)));
          }
        }
        const { left, top, right, bottom } = e.part(SIZE.w, SIZE.h);
        for (const [x, y] of painted) {
          if (x < 0 || y < 0 || x > SIZE.w || y > SIZE.h) continue;
          expect([x >= left, x <= right, y >= top, y <= bottom], `${x} ${y}`).toEqual([true, true, true, true]);
        }
      }),
    );
  });

  it('is a little larger than the painted part', () => {
    const e = extent(2);
    e.fillRect(50, 60, 10, 5);
    expect(e.part(SIZE.w, SIZE.h)).toEqual({ left: 98, top: 118, right: 122, bottom: 132 });
    const nothing = extent(2).part(SIZE.w, SIZE.h);
    expect(nothing.right > nothing.left).toBe(false);
  });

  it('covers shadows, letters and existing paths', () => {
    const e = extent(1);
    e.save();
    e.shadowBlur = 4;
    e.shadowOffsetY = 1;
    e.fillRect(100, 100, 10, 10);
    e.restore();
    expect(e.part(SIZE.w, SIZE.h)).toEqual({ left: 89, top: 89, right: 121, bottom: 121 });
    const text = extent(1);
    text.font = '600 10px Inter';
    text.fillText('abc', 200, 150);
    const { left, right } = text.part(SIZE.w, SIZE.h);
    expect(left).toBeLessThan(170);
    expect(right).toBeGreaterThan(230);
    const path = extent(1);
    path.lineJoin = 'round';
    path.lineWidth = 4;
    path.stroke({} as Path2D);
    expect(path.part(SIZE.w, SIZE.h).left).toBeLessThanOrEqual(8);
    expect(path.part(SIZE.w, SIZE.h).bottom).toBeGreaterThanOrEqual(42);
  });
});

/** The six numbers of a canvas, as its standard writes them. */
class Matrix {
  constructor(
    readonly a: number,
    readonly b: number,
    readonly c: number,
    readonly d: number,
    readonly e: number,
    readonly f: number,
  ) {}
  times(m: Matrix): Matrix {
    const { a, b, c, d, e, f } = this;
    return new Matrix(
      a * m.a + c * m.b,
      b * m.a + d * m.b,
      a * m.c + c * m.d,
      b * m.c + d * m.d,
      a * m.e + c * m.f + e,
      b * m.e + d * m.f + f,
    );
  }
  to([x, y]: Point): Point {
    return [this.a * x + this.c * y + this.e, this.b * x + this.d * y + this.f];
  }
}
