// What is asked of a generator and what becomes of its answers, with a generator that lives in the test.
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { clearGoal, setGoal, setOthers } from '../../src/model/commands';
import type { Editor } from '../../src/edit/editor';
import type { Generation } from '../../src/edit/generation';
import { draftOf, finalOf, json, Session, type InMemoryGenerator } from './session';

let editor: Editor;
let generator: InMemoryGenerator;
let generation: Generation;

beforeEach(() => {
  vi.useFakeTimers();
  ({ editor, generator, generation } = new Session());
});

const rest = () => vi.advanceTimersByTime(100);
const goalFor = (id: string) => {
  const a = editor.scene.peek()!.agents.get(id)!;
  editor.run(setGoal(a, { ...a.goal, pos: [10, 10] }));
};

describe('a look', () => {
  it('asks for the six futures of whom one selects, once', () => {
    editor.select('1');
    expect(generator.last).toMatchObject({ preview: true, options: { agents: ['1'], react: false, score: false } });
    expect(generator.last.scene()).toEqual({ id: json.id });
    expect(generation.busy.peek()).toBe(true);
    generator.last.on.draft(draftOf('1'), 2, 5, 10);
    expect(editor.draft.peek()).toMatchObject({ id: '1', futures: { step: 2 } });
    generator.last.on.final(finalOf('1'), 20);
    expect(editor.futures.peek()?.modes).toHaveLength(6);
    expect([generation.busy.peek(), editor.motion.peek().driving.size]).toEqual([false, 0]);
    editor.select(null);
    editor.select('1');
    expect(generator.asked).toHaveLength(1);
  });
});

describe('a change', () => {
  it('rests, then asks how the others react, and says who changed', () => {
    editor.select('1');
    goalFor('1');
    goalFor('1');
    const before = generator.asked.length;
    expect(editor.motion.peek().stale).toBe(true);
    rest();
    expect(generator.asked.length).toBe(before + 1);
    expect(generator.last).toMatchObject({ preview: false, options: { agents: ['1'], react: true, score: true } });
    expect(generator.last.options.conditions['1']).toMatchObject({ goal: { x_m: 10, y_m: 10 } });
    generator.last.on.final(finalOf('1', '2'), 30);
    expect(editor.motion.peek()).toMatchObject({ stale: false, driving: new Set(['1', '2']) });
    expect(editor.changes.peek().map((c) => c.id)).toEqual(['2']);
    expect(editor.notices.toast.peek()?.text).toMatch(/^Goal of Car 1.* 1 other changed\.$/);
  });

  it('asks nobody else when the others keep to the log', () => {
    editor.run(setOthers('log'));
    goalFor('1');
    rest();
    expect(generator.last.options).toMatchObject({ agents: ['1'], react: false });
  });

  it('that takes everything back is answered by the log, and only scored', () => {
    goalFor('1');
    rest();
    generator.last.on.final(finalOf('1'), 5);
    const asked = generator.asked.length;
    editor.run(clearGoal(editor.scene.peek()!.agents.get('1')!));
    rest();
    expect(generator.asked.length).toBe(asked);
    expect(editor.motion.peek()).toMatchObject({ stale: false, futures: new Map() });
  });

  it('shows an answer that is known at once, without asking', () => {
    goalFor('1');
    rest();
    generator.last.on.final(finalOf('1'), 5);
    const asked = generator.asked.length;
    editor.undo();
    editor.redo();
    rest();
    expect(editor.motion.peek().futures.has('1')).toBe(true);
    expect(generator.asked.slice(asked).filter((q) => !q.preview)).toEqual([]);
  });
});

describe('a generator that goes away', () => {
  it('is tried again, and then asked for what has waited', async () => {
    editor.select('1');
    goalFor('1');
    rest();
    generator.there = false;
    generator.last.on.away();
    expect(editor.away.peek()).toEqual({ retryIn: 1, waiting: 1 });
    expect(editor.futures.peek()?.sketch).toBe(true);
    const asked = generator.asked.length;
    goalFor('2');
    expect(editor.away.peek()?.waiting).toBe(2);
    await vi.advanceTimersByTimeAsync(1000);
    expect([editor.away.peek()?.retryIn, generator.asked.length]).toEqual([2, asked]);
    generator.there = true;
    await generation.tryNow();
    expect(editor.away.peek()).toBeNull();
    expect(generator.asked.length).toBe(asked + 1);
    expect(editor.notices.toast.peek()?.text).toBe('The generator is back. 2 changes worked out.');
  });
});

describe('a drag', () => {
  it('asks about the same surroundings with the same object, which is written once', () => {
    goalFor('1');
    rest();
    generator.last.on.final(finalOf('1'), 5);
    editor.select('2');
    generation.preview('2');
    const first = generator.last.scene();
    generation.preview('2');
    expect(generator.last.scene()).toEqual(first);
    expect((generator.last.scene() as { scene: unknown }).scene).toBe((first as { scene: unknown }).scene);
  });
});
