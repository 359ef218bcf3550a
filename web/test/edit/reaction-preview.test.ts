// Reactions of the others, requested during a drag and taken over by the release.
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { setGoal, setOthers, type Command } from '../../src/model/document/commands';
import { outOfReach } from '../../src/edit/moves/goal-verdict';
import type { ModeJson } from '../../src/model/document/scene-json';
import type { DraftEvent, FinalEvent } from '../../src/net/types';
import { judged } from '../standin/judged.mjs';
import { answered, draftOf, finalOf, finalWith, late, Session, six } from './session';

let s: Session;

beforeEach(() => {
  vi.useFakeTimers();
  s = new Session();
});

const goalAt = (x: number): Command => {
  const a = s.editor.scene.peek()!.agents.get('1')!;
  return setGoal(a, { ...a.goal, pos: [x, 10] });
};

/** A frame of the drag; the drag's own question shows its first draft unless it must wait. */
async function frame(x: number, { shown = true } = {}): Promise<void> {
  s.editor.drag.preview(goalAt(x));
  s.generation.preview('1');
  if (shown) s.generator.last.on.draft(draftOf('1'), 0, 5, 8);
  await Promise.resolve();
}

function begin(): void {
  s.editor.select('1');
  s.editor.drag.begin({ part: 'goal', handle: 'body' });
}

const goalOf = (q: { options: { conditions: object } }): number =>
  (q.options.conditions as Record<string, { goal: { x_m: number } }>)['1'].goal.x_m;
const releaseAt = (x: number) => s.editor.drag.end(goalAt(x));
const answer = (others: Parameters<typeof answered>[1], ms = 30) => s.others.last.on.final(answered('1', others), ms);
const names = () => s.editor.answers.previewed.peek()?.map((c) => `${c.name} ${c.words}`);

describe('while a handle is dragged', () => {
  it("sends the release's request on a connection of its own", async () => {
    begin();
    await frame(10);
    expect(s.generator.last.options).toMatchObject({ agents: ['1'], react: false });
    const previewed = s.others.last;
    releaseAt(10);
    s.others.last.on.dropped!();
    const asked = s.generator.last;
    expect(asked.preview).toBe(false);
    const { background, ...previewedOptions } = previewed.options;
    expect(background).toBe(true);
    // Only the streaming differs: its drafts are not shown.
    const sent = { stream_modes: 'all', draft_delay_ms: 8, draft_interval_ms: 16 };
    expect({ ...previewedOptions, ...sent }).toEqual(asked.options);
    expect(previewed.scene()).toEqual(asked.scene());
  });

  it("lets the drag's own futures go first", async () => {
    begin();
    await frame(10, { shown: false });
    expect(s.others.asked).toHaveLength(0);
    s.generator.last.on.draft(draftOf('1'), 0, 5, 8);
    await Promise.resolve();
    expect(s.others.asked).toHaveLength(1);
  });

  it('has at most one question under way, and sends the newest pose next', async () => {
    begin();
    for (let x = 10; x < 30; x++) await frame(x);
    expect(s.others.asked.map(goalOf)).toEqual([10]);
    answer({});
    expect(s.others.asked).toHaveLength(1);
    vi.advanceTimersByTime(150);
    expect(s.others.asked.map(goalOf)).toEqual([10, 29]);
    answer({});
    vi.advanceTimersByTime(2000);
    expect(s.others.asked).toHaveLength(2);
    expect(s.generation.asking.peek()).toBe(true);
    for (const q of s.generator.asked) q.on.dropped!();
    expect(s.generation.asking.peek()).toBe(false);
  });

  it('sends at least five requests a second while the drag moves', async () => {
    begin();
    for (let ms = 0; ms < 2000; ms += 16) {
      await frame(10 + ms / 100);
      vi.advanceTimersByTime(16);
      if (ms % 48 === 0) s.others.last.on.final(answered('1', {}), 40);
    }
    expect(s.others.asked.length).toBeGreaterThanOrEqual(10);
  });

  it('drops a question about an older pose once the drag rests at another', async () => {
    begin();
    await frame(10);
    await frame(20);
    expect(s.others.cancelled).toBe(0);
    vi.advanceTimersByTime(200);
    expect(s.others.cancelled).toBe(1);
    expect(s.others.asked.map(goalOf)).toEqual([10, 20]);
    // The drag still rests there: this one is awaited, however long it takes.
    vi.advanceTimersByTime(5000);
    expect(s.others.asked).toHaveLength(2);
    expect(s.others.cancelled).toBe(1);
  });

  it('reports the reactions and their causes, most affected first, and leaves the picture unchanged', async () => {
    begin();
    await frame(10);
    const before = s.editor.answers.motion.peek();
    answer({ '2': late('2', 1, '1'), '3': late('3', 3, '1'), '4': late('4', 0) });
    expect(names()).toEqual([expect.stringMatching(/^Car 3 .* Car 1$/), expect.stringMatching(/^Car 2 .* Car 1$/)]);
    expect(s.editor.answers.motion.peek()).toBe(before);
  });

  it('shows the six futures judged with reactions while the drag rests', async () => {
    begin();
    await frame(10);
    s.others.last.on.final(finalWith({ '1': { ...six('1'), chosen: 3 } }), 30);
    expect(s.editor.reading.chosen.peek()).toBe(3);
    s.generator.last.on.draft(draftOf('1'), 4, 5, 12);
    s.generator.last.on.final(finalOf('1'), 14);
    expect(s.editor.reading.chosen.peek()).toBe(3);
    await frame(11);
    expect(s.editor.reading.chosen.peek()).toBe(0);
    // An answer about a former pose does not change the six.
    vi.advanceTimersByTime(150);
    await frame(12);
    s.others.last.on.final(finalWith({ '1': { ...six('1'), chosen: 3 } }), 30);
    expect(s.editor.reading.chosen.peek()).toBe(0);
  });

  it('reports no collision with a road user that would give way', async () => {
    const hits = (id: string) => ({ kind: 'collision', time_s: 3, until_s: 3, x_m: 0, y_m: 0, extent: 5, with: id });
    const modes = six('1').modes.map((m) => ({ ...m, faults: [hits('2'), hits('3')] }));
    const draft = { event: 'step', window: 0, agents: { '1': { chosen: 0, modes } } } as unknown as DraftEvent;
    const hit = () => s.editor.answers.draft.peek()!.futures.modes[0].about!.faults.map((f) => f.with);
    begin();
    await frame(10);
    s.generator.last.on.draft(draft, 1, 5, 8);
    expect(hit()).toEqual(['2', '3']);
    answer({ '2': late('2', 3, '1') });
    await frame(11, { shown: false });
    s.generator.last.on.draft(draft, 1, 5, 8);
    expect(hit()).toEqual(['3']);
  });

  it('changes a verb only after a while of agreement', async () => {
    begin();
    await frame(10);
    answer({ '2': late('2', 3, '1') });
    const first = names();
    await frame(11);
    vi.advanceTimersByTime(150);
    answer({ '2': late('2', 3, '3') });
    expect(names()).toEqual(first);
    vi.advanceTimersByTime(400);
    expect(names()).toEqual([expect.stringMatching(/Car 3$/)]);
  });

  it('sends nothing where the others do not react', async () => {
    for (const others of ['log', 'still'] as const) {
      s = new Session();
      s.editor.commits.run(setOthers(others));
      begin();
      await frame(10);
      vi.advanceTimersByTime(500);
      expect(s.others.asked).toHaveLength(0);
      expect(s.editor.answers.previewed.peek()).toBeNull();
    }
  });

  it('drops everything on Esc', async () => {
    begin();
    await frame(10);
    answer({ '2': late('2', 3, '1') });
    vi.advanceTimersByTime(150);
    await frame(20);
    s.editor.drag.cancel();
    s.generation.cancelPreviews();
    for (const q of s.generator.asked) q.on.dropped!();
    expect([s.editor.answers.previewed.peek(), s.others.cancelled, s.generation.asking.peek()]).toEqual([
      null,
      1,
      false,
    ]);
    answer({ '2': late('2', 3, '1') });
    expect(s.editor.answers.previewed.peek()).toBeNull();
  });
});

describe('a release', () => {
  it('takes over the preview of exactly this pose, without a request', async () => {
    begin();
    await frame(10);
    answer({ '2': late('2', 3, '1'), '3': late('3', 1, '2') });
    const previewed = s.editor.answers.previewed.peek()!;
    const asked = s.generator.asked.length;
    releaseAt(10);
    expect(s.editor.answers.motion.peek().stale).toBe(false);
    expect(s.generator.asked.slice(asked).filter((q) => !q.preview)).toEqual([]);
    expect(s.editor.answers.previewed.peek()).toBeNull();
    const changes = s.editor.answers.changes.peek();
    expect(changes.map((c) => c.words)).toEqual(previewed.map((c) => c.words));
    expect(changes.map((c) => c.place)).toEqual(previewed.map((c) => c.place));
    expect(s.editor.notices.toast.peek()?.text).toMatch(/2 others changed\.$/);
    vi.advanceTimersByTime(1000);
    expect(s.generator.asked.slice(asked).filter((q) => !q.preview)).toEqual([]);
  });

  it('waits for the answer to exactly this pose when it is under way', async () => {
    begin();
    await frame(10);
    const asked = s.generator.asked.length;
    releaseAt(10);
    expect([s.editor.answers.motion.peek().stale, s.generation.asking.peek()]).toEqual([true, true]);
    answer({ '2': late('2', 3, '1') });
    expect(s.editor.answers.changes.peek().map((c) => c.id)).toEqual(['2']);
    expect(s.editor.answers.motion.peek().stale).toBe(false);
    expect(s.generator.asked.slice(asked).filter((q) => !q.preview)).toEqual([]);
  });

  it('at another pose is requested like any change', async () => {
    begin();
    await frame(10);
    answer({ '2': late('2', 3, '1') });
    releaseAt(12);
    vi.advanceTimersByTime(100);
    expect(s.generator.last).toMatchObject({ preview: false, options: { react: true } });
    expect(goalOf(s.generator.last)).toBe(12);
    // The preview stays on screen until the answer arrives.
    expect(s.editor.answers.previewed.peek()).toHaveLength(1);
    s.generator.last.on.final(finalOf('1'), 20);
    expect([s.editor.answers.previewed.peek(), s.editor.answers.changes.peek()]).toEqual([null, []]);
  });

  it('sends its own request when the awaited answer fails', async () => {
    begin();
    await frame(10);
    releaseAt(10);
    s.others.last.on.refused({ code: 'busy', title: 'busy' });
    expect(s.generator.last).toMatchObject({ preview: false, options: { agents: ['1'], react: true } });
  });
});

describe('a blocked goal', () => {
  const BLOCKED = {
    status: 'unreachable',
    limiting: 'traffic',
    needs: null,
    nearest: { x_m: 7, y_m: 10, heading_rad: 0, speed_mps: 0 },
    words: 'Another road user blocks this vehicle, which stops 3 m short of the goal.',
    with: '2',
  };
  const REACHED = { status: 'reached', position_m: 0.1, heading_rad: 0, speed_mps: 0 };
  const fixed = { value: 0, from: 'user' };
  const goal = { x_m: fixed, y_m: fixed, heading_rad: fixed, speed_mps: fixed, time_s: fixed };
  const about = (e: FinalEvent, reach: object) =>
    ({ ...e, resolved: { '1': { goal, reach } } }) as unknown as FinalEvent;
  const said = () => outOfReach(s.editor, s.editor.agent.peek()!);

  it('is known once the others have reacted', async () => {
    begin();
    await frame(10);
    s.generator.last.on.final(about(finalOf('1'), BLOCKED), 5);
    expect(s.editor.answers.liveReach.peek()).toBeNull();
    s.others.last.on.final(about(answered('1', {}), BLOCKED), 30);
    expect(said()).toMatchObject({ title: 'Car 2 is in the way', words: 'Stops 3 m short.' });
    await frame(20);
    vi.advanceTimersByTime(150);
    s.others.last.on.final(about(answered('1', {}), REACHED), 30);
    s.generator.last.on.final(about(finalOf('1'), BLOCKED), 5);
    expect([said(), s.editor.answers.liveReach.peek()?.reach.status]).toEqual([null, 'reached']);
  });

  it('is reported only for a goal of its own', async () => {
    begin();
    await frame(10);
    await frame(12);
    s.others.last.on.final(about(answered('1', {}), BLOCKED), 30);
    expect(s.editor.answers.liveReach.peek()).toBeNull();
  });

  it('is not reported beside a collision', async () => {
    begin();
    await frame(10);
    const hits = judged(six('1').modes as ModeJson[], ['2', '17'], true);
    const answer = {
      ...finalOf(),
      samples: [{ agents: { '1': { chosen: 0, modes: hits } } }],
    } as unknown as FinalEvent;
    s.others.last.on.final(about(answer, { ...BLOCKED, with: null }), 30);
    expect(s.editor.reading.futures.peek()!.modes[0].about!.faults[0].kind).toBe('collision');
    expect(said()).toMatchObject({ title: 'Car 2 is in the way', outranked: true });
  });
});
