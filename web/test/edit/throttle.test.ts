// Panels during a drag.
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { computed, effect, signal } from '@preact/signals-core';
import { Throttle } from '../../src/edit/session/throttle';

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

function panel() {
  const dragging = signal(false);
  const shown = signal(0);
  const calm = new Throttle(dragging, () => void shown.value);
  const said: number[] = [];
  const told = computed(() => calm.read(() => shown.value));
  effect(() => void said.push(told.value));
  return { dragging, shown, calm, said };
}

test('follows at once outside a drag', () => {
  const { shown, said, calm } = panel();
  shown.value = 1;
  shown.value = 2;
  expect(said).toEqual([0, 1, 2]);
  expect(calm.waiting.value).toBe(false);
});

test('follows a drag at intervals, with the newest value', () => {
  const { dragging, shown, said, calm } = panel();
  dragging.value = true;
  for (let i = 1; i <= 60; i++) {
    shown.value = i;
    vi.advanceTimersByTime(1000 / 60);
  }
  expect(said.length).toBeGreaterThan(6);
  expect(said.length).toBeLessThan(13);
  vi.advanceTimersByTime(100);
  expect(said.at(-1)).toBe(60);
  expect(calm.waiting.value).toBe(false);
});

test('shows the last value when the drag ends', () => {
  const { dragging, shown, said, calm } = panel();
  dragging.value = true;
  shown.value = 1;
  expect(said.at(-1)).toBe(0);
  expect(calm.waiting.value).toBe(true);
  dragging.value = false;
  expect(said.at(-1)).toBe(1);
  expect(calm.waiting.value).toBe(false);
});
