// The box that runs along the future under the pointer.
import { expect, it } from 'vitest';
import { replayed } from '../../src/edit/overlay/hovered';

it('runs at four times the speed, rests at the end, and starts again', () => {
  expect(replayed(0, 9)).toBe(0);
  expect(replayed(1, 9)).toBe(4);
  expect(replayed(2.25, 9)).toBe(9);
  expect(replayed(2.7, 9)).toBe(9);
  expect(replayed(2.25 + 0.6 + 0.5, 9)).toBeCloseTo(2);
});
