import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { RestTimer } from '../../src/edit/asking/rest-timer';

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

it('waits while something happens, and then runs once', () => {
  const rest = new RestTimer(100);
  const done: number[] = [];
  for (let i = 0; i < 30; i++) {
    rest.begin(() => done.push(i));
    vi.advanceTimersByTime(16);
  }
  expect(done).toEqual([]);
  vi.advanceTimersByTime(83);
  expect(done).toEqual([]);
  vi.advanceTimersByTime(26);
  expect(done).toEqual([29]);
  vi.advanceTimersByTime(1000);
  expect(done).toEqual([29]);
  expect(vi.getTimerCount()).toBe(0);
});

it('restarts, and can be cancelled', () => {
  const rest = new RestTimer(100);
  const done = vi.fn();
  rest.begin(done);
  vi.advanceTimersByTime(60);
  rest.stop();
  vi.advanceTimersByTime(500);
  expect(done).not.toHaveBeenCalled();
  rest.begin(done);
  vi.advanceTimersByTime(100);
  expect(done).toHaveBeenCalledOnce();
});
