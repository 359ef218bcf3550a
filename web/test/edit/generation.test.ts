// What is asked of a generator and what becomes of its answers, with a generator that lives in the test.
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { clearGoal, setGoal, setOthers } from '../../src/model/commands';
import { Editor } from '../../src/edit/editor';
import { Generation } from '../../src/edit/generation';
import { SceneFile } from '../../src/edit/scene-file';
import { SceneList } from '../../src/edit/scene-list';
import { Saving } from '../../src/edit/saving';
import { Client } from '../../src/net/client';
import type { Generator, Question, SceneRef, Trajectories } from '../../src/net/generator';
import type { DraftEvent, FinalEvent, ScoreReply } from '../../src/net/types';
import { isMapRef, type MapJson } from '../../src/model/json';
import { readScene } from '../../src/model/read';
import { crossingJson } from '../helpers';
import { sixFutures } from '../standin/futures.mjs';

/** A score in which nothing happens; of the rest the editor reads nothing. */
const uneventful = {
  scene: { collisions: [], near_misses: [], min_ttc_s: null, offroad_share: null },
} as unknown as ScoreReply;

/** Keeps the questions; the test answers them when it likes. */
class InMemoryGenerator implements Generator {
  readonly asked: Question[] = [];
  readonly scored: { scene: SceneRef; ids: string[] }[] = [];
  cancelled = 0;
  there = true;

  ask(q: Question): void {
    this.asked.push(q);
  }

  cancel(): void {
    this.cancelled++;
  }

  async score(scene: SceneRef, trajectories: Trajectories): Promise<ScoreReply> {
    this.scored.push({ scene, ids: Object.keys(trajectories) });
    return uneventful;
  }

  answers(): Promise<boolean> {
    return Promise.resolve(this.there);
  }

  get last(): Question {
    return this.asked.at(-1)!;
  }
}

const json = crossingJson();
const modes = (id: string) => ({
  chosen: 0,
  modes: sixFutures(
    json.agents.find((a) => a.id === id)!,
    undefined,
    5,
    5,
  ),
});
const draftOf = (...ids: string[]) =>
  ({ event: 'step', window: 0, agents: Object.fromEntries(ids.map((id) => [id, modes(id)])) }) as unknown as DraftEvent;
const finalOf = (...ids: string[]) =>
  ({
    event: 'final',
    samples: [{ agents: Object.fromEntries(ids.map((id) => [id, modes(id)])) }],
    resolved: {},
    scores: [uneventful],
    warnings: [],
  }) as unknown as FinalEvent;

let editor: Editor;
let generator: InMemoryGenerator;
let others: InMemoryGenerator;
let generation: Generation;

beforeEach(() => {
  vi.useFakeTimers();
  editor = new Editor();
  generator = new InMemoryGenerator();
  const file = new SceneFile(editor);
  const client = new Client('', () => Promise.reject(new Error('nothing is fetched here')));
  const saving = new Saving(editor, file, new SceneList(client), client);
  others = new InMemoryGenerator();
  generation = new Generation(editor, file, saving, generator, others);
  file.adopt(json, isMapRef(json.map) ? ({} as MapJson) : json.map, true);
  editor.open(readScene(json));
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
