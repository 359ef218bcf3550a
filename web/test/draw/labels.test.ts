// Placement of labels: never over another, and over objects below only without an alternative.
import { describe, expect, it } from 'vitest';
import { Labels } from '../../src/draw/labels';

const TRIES = [
  [10, 0],
  [-60, 0],
  [0, 40],
] as const;
const place = (l: Labels, must = true) => l.place(100, 100, 50, 20, TRIES, must);

describe('a label', () => {
  it('avoids objects below it while there is another place', () => {
    const labels = new Labels({ w: 400, h: 400, dpr: 1 });
    labels.keepOff({ x: 110, y: 100, w: 20, h: 20 });
    expect(place(labels)).toMatchObject({ x: 40, y: 100 });
    expect(place(labels)).toMatchObject({ x: 100, y: 140 });
    // The last place is over a road user, which is better than over another label.
    expect(place(labels)).toMatchObject({ x: 110, y: 100 });
    expect(place(labels, false)).toBeNull();
  });

  it('is no label of what is under a panel, but of what is beside a rail', () => {
    const beside = (left: number) => new Labels({ w: 900, h: 400, dpr: 1 }, { left, right: 0, top: 0, bottom: 0 });
    expect(beside(400).outside(300, 200)).toBe(true);
    expect(beside(400).outside(500, 200)).toBe(false);
    expect(beside(90).outside(40, 200)).toBe(false);
    expect(beside(90).outside(-20, 200)).toBe(true);
  });
});
