// Words about the others do not flicker.
import { beforeEach, expect, it, vi } from 'vitest';
import type { Change } from '../../src/model/words/change-words';
import { AGREED_MS, StableWords } from '../../src/edit/asking/stable-words';

const change = (id: string, kind: 'waits' | 'slows', lost = 1): Change =>
  ({ id, lost, size: 1, reaction: { kind, cause: { id: '7', name: 'Car 7' }, ahead: false } }) as unknown as Change;

let said: string[];
let steady: StableWords;
beforeEach(() => {
  vi.useFakeTimers();
  steady = new StableWords((all) => {
    said = all.map((c) => `${c.id} ${c.reaction!.kind} ${c.lost}`);
  });
});

it('reports a new one at once, most affected first', () => {
  steady.hear([change('2', 'waits', 1), change('3', 'slows', 4)]);
  expect(said).toEqual(['3 slows 4', '2 waits 1']);
});

it('follows the numbers of the same verb at once', () => {
  steady.hear([change('2', 'waits', 1)]);
  steady.hear([change('2', 'waits', 2)]);
  expect(said).toEqual(['2 waits 2']);
});

it('changes a verb after a while of agreement, also without further answers', () => {
  steady.hear([change('2', 'waits')]);
  steady.hear([change('2', 'slows')]);
  vi.advanceTimersByTime(AGREED_MS - 1);
  expect(said).toEqual(['2 waits 1']);
  vi.advanceTimersByTime(1);
  expect(said).toEqual(['2 slows 1']);
});

it('does not flicker between two', () => {
  for (let i = 0; i < 20; i++) {
    steady.hear(i % 2 ? [] : [change('2', 'waits')]);
    expect(said).toEqual(['2 waits 1']);
    vi.advanceTimersByTime(AGREED_MS / 2);
  }
  steady.hear([]);
  vi.advanceTimersByTime(AGREED_MS);
  expect(said).toEqual([]);
});

it('reports nothing after the end of a drag', () => {
  steady.hear([change('2', 'waits')]);
  steady.hear([]);
  steady.forget();
  said = ['unchanged'];
  vi.advanceTimersByTime(10 * AGREED_MS);
  expect(said).toEqual(['unchanged']);
});
