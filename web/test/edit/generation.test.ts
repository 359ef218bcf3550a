// Requests to a generator and the handling of its answers, with a generator inside the test.
import { beforeEach, describe, expect, it, vi } from 'vitest';
import {
  clearGoal,
  resetAgent,
  setGoal,
  setLength,
  setOthers,
  setSeed,
  setSize,
} from '../../src/model/document/commands';
import type { SpeedCurve } from '../../src/edit/tools/speed-curve/speed-curve';
import type { Editor } from '../../src/edit/session/editor';
import { requestForChange } from '../../src/edit/asking/request-for-change';
import { pickFuture } from '../../src/edit/moves/moves';
import type { Generation } from '../../src/edit/asking/generation';
import type { DraftEvent, FinalEvent } from '../../src/net/types';
import type { AgentFuturesJson, ModeJson, SceneJson } from '../../src/model/document/scene-json';
import { asIfNotAsked, thoseWhoAnswer } from '../../src/model/document/reaction-records';
import { emptyMotion } from '../../src/model/document/futures';
import { readScene } from '../../src/model/document/scene-reader';
import { readGenerated } from '../../src/model/words/named-futures';
import { generatedJson, writeScene } from '../../src/model/document/scene-writer';
import { nameAll } from '../../src/model/words/future-names';
import { nameIn, profileOf, withAgents } from '../../src/model/document/scene';
import { judged } from '../standin/judged.mjs';
import { answered, draftOf, finalOf, finalWith, json, late, Session, six, type InMemoryGenerator } from './session';

let curve: SpeedCurve;
let editor: Editor;
let generator: InMemoryGenerator;
let others: InMemoryGenerator;
let generation: Generation;

beforeEach(() => {
  vi.useFakeTimers();
  ({ curve, editor, generator, others, generation } = new Session());
});

const rest = () => vi.advanceTimersByTime(100);
const goalOf = (id: string) => {
  const a = editor.scene.peek()!.agents.get(id)!;
  return setGoal(a, { ...a.goal, pos: [10, 10] });
};
const goalFor = (id: string) => editor.commits.run(goalOf(id));
/** The same by a drag. */
const dragGoal = (id: string) => {
  editor.drag.begin({ part: 'goal', handle: 'body' });
  editor.drag.preview(goalOf(id));
  editor.drag.end(goalOf(id));
};

describe('a selection', () => {
  it('requests the six futures of the selected road user, once', () => {
    editor.select('1');
    expect(generator.last).toMatchObject({ preview: true, options: { agents: ['1'], react: true, score: false } });
    expect(generator.last.scene()).toEqual({ id: json.id });
    expect(generation.asking.peek()).toBe(true);
    generator.last.on.draft(draftOf('1'), 2, 5, 10);
    expect(editor.answers.draft.peek()).toMatchObject({ id: '1', futures: { step: 2 } });
    generator.last.on.final(finalOf('1'), 20);
    expect(editor.reading.futures.peek()?.modes).toHaveLength(6);
    expect([generation.asking.peek(), editor.answers.motion.peek().driving.size]).toEqual([false, 0]);
    editor.select(null);
    editor.select('1');
    expect(generator.asked).toHaveLength(1);
  });
});

describe('a change', () => {
  it('waits, then requests reactions, and reports them', () => {
    editor.select('1');
    goalFor('1');
    goalFor('1');
    const before = generator.asked.length;
    expect(editor.answers.motion.peek().stale).toBe(true);
    rest();
    expect(generator.asked.length).toBe(before + 1);
    expect(generator.last).toMatchObject({ preview: false, options: { agents: ['1'], react: true, score: true } });
    expect(generator.last.options.conditions['1']).toMatchObject({ goal: { x_m: 10, y_m: 10 } });
    generator.last.on.final(finalOf('1', '2'), 30);
    expect(editor.answers.motion.peek()).toMatchObject({ stale: false, driving: new Set(['1', '2']) });
    expect(editor.answers.changes.peek().map((c) => c.id)).toEqual(['2']);
    expect(editor.notices.toast.peek()?.text).toMatch(/^Goal of Car 1.* 1 other changed\.$/);
  });

  it('redone reports the reactions again, and undone reports none', () => {
    goalFor('1');
    rest();
    generator.last.on.final(finalOf('1', '2'), 30);
    const changed = editor.answers.changes.peek();
    expect(changed.map((c) => c.id)).toEqual(['2']);
    editor.commits.undo();
    expect(editor.answers.changes.peek()).toEqual([]);
    editor.commits.redo();
    expect(editor.answers.changes.peek()).toEqual(changed);
  });

  it('that is not answered yet is requested with the pick of another road user', () => {
    goalFor('1');
    rest();
    generator.last.on.final(finalOf('1'), 5);
    goalFor('2');
    editor.select('1');
    editor.commits.run(pickFuture(editor, editor.agent.peek()!, 2)!);
    rest();
    expect(generator.last.options).toMatchObject({ agents: ['1', '2'], pinned: ['1'], react: true });
    expect(Object.keys(generator.last.options.conditions)).toEqual(['1', '2']);
  });

  it('that is not answered yet sends no goal with the drag of another road user', () => {
    goalFor('1');
    editor.select('2');
    editor.drag.begin({ part: 'goal', handle: 'body' });
    editor.drag.preview(goalOf('2'));
    generation.preview('2');
    expect(generator.last.options).toMatchObject({ agents: ['2'], react: false });
    expect(Object.keys(generator.last.options.conditions)).toEqual(['2']);
  });

  it('requests no others when they replay the recording', () => {
    editor.commits.run(setOthers('log'));
    goalFor('1');
    rest();
    expect(generator.last.options).toMatchObject({ agents: ['1'], react: false });
  });

  it('that removes all conditions is answered by the recording, and only scored', () => {
    goalFor('1');
    rest();
    generator.last.on.final(finalOf('1'), 5);
    const asked = generator.asked.length;
    editor.commits.run(clearGoal(editor.scene.peek()!.agents.get('1')!));
    rest();
    expect(generator.asked.length).toBe(asked);
    expect(editor.answers.motion.peek()).toMatchObject({ stale: false, futures: new Map() });
  });

  it('shows a known answer at once, without a request', () => {
    goalFor('1');
    rest();
    generator.last.on.final(finalOf('1'), 5);
    const asked = generator.asked.length;
    editor.commits.undo();
    editor.commits.redo();
    rest();
    expect(editor.answers.motion.peek().futures.has('1')).toBe(true);
    expect(generator.asked.slice(asked).filter((q) => !q.preview)).toEqual([]);
  });
});

describe('a speed curve', () => {
  const speeds = () => profileOf(editor.agent.peek()!)?.points.map((p) => p.v);
  const answered = () => {
    rest();
    generator.last.on.final(finalOf('1'), 5);
  };

  beforeEach(() => {
    editor.select('1');
    generator.last.on.final(finalOf('1'), 5);
    curve.add(4, 0, 2);
    answered();
    expect(speeds()).toHaveLength(3);
  });

  it('is drawn along the new path when a change sets no other speed, within the same step', () => {
    const { depth } = editor.document.history!;
    editor.commits.run(setSize(editor.agent.peek()!, 5, 2));
    expect(speeds()).toBeUndefined();
    answered();
    expect(speeds()).toHaveLength(3);
    expect([editor.document.history!.depth, editor.document.undoName.peek()]).toEqual([
      depth + 1,
      'Size of Car 1 changed',
    ]);
    editor.commits.undo();
    expect([speeds()?.length, editor.agent.peek()!.length]).not.toEqual([3, 5]);
    editor.commits.redo();
    expect([speeds()?.length, editor.agent.peek()!.length]).toEqual([3, 5]);
  });

  it.each([
    ['typed', () => goalFor('1')],
    ['dragged', () => dragGoal('1')],
  ])('that a new goal speaks against is off, which is said, and can be kept: %s', (_, newGoal) => {
    newGoal();
    answered();
    expect(speeds()).toBeUndefined();
    const { text, action } = editor.notices.toast.peek()!;
    expect(text).toMatch(/The speed curve no longer applies\.$/);
    action!.run();
    expect(speeds()).toHaveLength(3);
  });
});

describe('a speed curve whose change is answered during a drag', () => {
  const curved = () => profileOf(editor.scene.peek()!.agents.get('1')!) !== null;

  beforeEach(() => {
    editor.select('1');
    generator.last.on.final(finalOf('1'), 5);
    curve.add(4, 0, 2);
    rest();
    generator.last.on.final(finalOf('1'), 5);
    editor.commits.run(setSize(editor.agent.peek()!, 5, 2));
    rest();
    editor.drag.begin({ part: 'goal', handle: 'body' });
    generator.last.on.final(finalOf('1'), 5);
  });

  it('is drawn once the drag is cancelled, within the step of the change', () => {
    expect(curved()).toBe(false);
    editor.drag.cancel();
    expect(curved()).toBe(true);
    expect(editor.document.undoName.peek()).toBe('Size of Car 1 changed');
  });

  it('is off where the drag changes the goal, and no step names a document that never existed', () => {
    editor.drag.end(goalOf('1'));
    expect([editor.scene.peek()!.agents.get('1')!.goal.pos, curved()]).toEqual([[10, 10], false]);
    editor.commits.undo();
    editor.commits.undo();
    expect(curved()).toBe(true);
    editor.commits.redo();
    expect([editor.scene.peek()!.agents.get('1')!.length, curved()]).toEqual([5, false]);
  });

  it('is offered once more when the drag is answered', () => {
    editor.drag.end(goalOf('1'));
    rest();
    generator.last.on.final(finalOf('1'), 5);
    expect(curved()).toBe(false);
    expect(editor.notices.toast.peek()!.text).toMatch(/The speed curve no longer applies\.$/);
    editor.notices.toast.peek()!.action!.run();
    expect(curved()).toBe(true);
  });
});

describe('a pick among futures', () => {
  const pick = (index: number) => {
    editor.commits.run(pickFuture(editor, editor.agent.peek()!, index)!);
    rest();
  };
  const asked = () => (generator.last.scene() as { scene: SceneJson }).scene.generated!.samples[0].agents;

  beforeEach(() => {
    editor.select('1');
    generator.last.on.final(finalOf('1'), 5);
  });

  it('requests only that one, pinned, with the reactions of the others', () => {
    pick(2);
    expect(generator.last).toMatchObject({ preview: false });
    expect(generator.last.options).toMatchObject({ agents: ['1'], pinned: ['1'], react: true, score: true });
    expect(generator.last.options.shown).toBeUndefined();
    expect(Object.keys(asked())).toEqual(['1']);
    expect(asked()['1']).toMatchObject({ chosen: 0, modes: [{ probability: six('1').modes[2].probability }] });
  });

  it('requests its continuation past 9 s, also where no other road user is requested', () => {
    editor.commits.run(setOthers('log'));
    const asked9 = generator.asked.length;
    pick(2);
    expect(generator.asked.length).toBe(asked9);
    editor.commits.run(setLength(editor.scene.peek()!, 15));
    pick(1);
    expect(generator.last.options).toMatchObject({ agents: ['1'], pinned: ['1'], react: false, horizon_s: 15 });
    expect(Object.keys(asked())).toEqual(['1']);
  });

  it('is scored without reactions: others have a collision only with their own fault', async () => {
    editor.commits.run(setOthers('log'));
    const hits = six('2');
    const hit = { kind: 'collision', with: '1', time_s: 3, until_s: 3, x_m: 0, y_m: 0, extent: 9 };
    for (const m of hits.modes) Object.assign(m, { faults: [hit], relations: [] });
    for (const id of ['1', '2']) {
      goalFor(id);
      rest();
      generator.last.on.final(finalOf(id), 5);
    }
    editor.select('1');
    pick(2);
    // A road user without a pick is drawn with it.
    expect(generator.last.options).toMatchObject({ agents: ['2'], react: false });
    generator.last.on.final(finalWith({ 2: hits }), 5);
    expect(editor.reading.events.peek().map((x) => x.kind)).toContain('collision');
    editor.select('2');
    const asked = generator.asked.length;
    pick(1);
    await vi.runAllTimersAsync();
    expect(generator.asked.length).toBe(asked);
    expect(editor.reading.events.peek().filter((x) => x.kind === 'collision')).toEqual([]);
    expect(editor.answers.motion.peek().futures.get('2')!.modes[1].about?.faults).toEqual([]);
  });

  it('changes only road users with a reaction', () => {
    pick(2);
    generator.last.on.final(finalWith({ '2': late('2', 3, '1') }), 5);
    expect(editor.answers.motion.peek()).toMatchObject({ stale: false, driving: new Set(['1', '2']) });
    expect(editor.answers.changes.peek().map((c) => [c.id, c.reaction?.cause.id])).toEqual([['2', '1']]);
    expect([editor.reading.futures.peek()!.modes.length, editor.reading.chosen.peek()]).toEqual([6, 2]);
  });

  it('is answered from the recording on, whatever was picked before', () => {
    const told = () => editor.answers.changes.peek().map((c) => [c.id, c.words]);
    pick(2);
    generator.last.on.final(finalWith({ '2': late('2', 3, '1') }), 5);
    const [[, first]] = told();
    pick(3);
    expect(Object.keys(asked())).toEqual(['1']);
    // The same reaction is reported again, instead of "no other agent is affected".
    generator.last.on.final(finalWith({ '2': late('2', 3, '1') }), 5);
    expect(told()).toEqual([['2', first]]);
    pick(4);
    generator.last.on.final(finalWith({}), 5);
    expect(editor.answers.motion.peek().driving).toEqual(new Set(['1']));
    expect(told()).toEqual([['2', 'no longer reacts to Car 1']]);
    // A third one's change does not affect reactions to another.
    pick(3);
    generator.last.on.final(finalWith({ '2': late('2', 3, '1') }), 5);
    editor.select('3');
    generator.last.on.final(finalOf('3'), 5);
    pick(1);
    expect(Object.keys(asked()).sort()).toEqual(['1', '2', '3']);
    generator.last.on.final(finalWith({}), 5);
    expect([...editor.answers.motion.peek().driving].sort()).toEqual(['1', '2', '3']);
    // The first one has no conditions any more: it replays the recording, and none reacts to it.
    editor.commits.run(resetAgent(editor.scene.peek()!.agents.get('1')!));
    rest();
    expect(Object.keys(asked())).toEqual(['3']);
  });

  it('frees a reacting road user again when the scene is read from a file', () => {
    pick(2);
    generator.last.on.final(finalWith({ '2': late('2', 3, '1') }), 5);
    const scene = editor.scene.peek()!;
    const { futures, answering } = editor.answers.motion.peek();
    const written = writeScene(json, scene, generatedJson(scene, futures, undefined, answering));
    const read = readGenerated(written, readScene(written))!;
    expect(read.answering.get('2')).toMatchObject({ said: { cause: '1', kind: 'waits' }, gaveUp: null });
    expect(thoseWhoAnswer(scene, read, ['1'])).toEqual(new Set(['2']));
    expect(thoseWhoAnswer(scene, read, ['3'])).toEqual(new Set());
  });

  it('restores the earlier motion of a placed road user that reacted', () => {
    const scene = editor.scene.peek()!;
    const placed = { ...scene.agents.get('2')!, placed: true };
    const there = withAgents(scene, [placed]);
    pick(2);
    generator.last.on.final(finalWith({ '2': late('2', 3, '1') }), 5);
    const { futures } = editor.answers.motion.peek();
    const own = { futures: futures.get('1')! };
    const { said } = editor.answers.motion.peek().answering.get('2')!;
    const answering = new Map([['2', { said, gaveUp: own }]]);
    const set = { ...emptyMotion(''), futures, driving: new Set(['2']), answering };
    const again = asIfNotAsked(set, thoseWhoAnswer(there, set, ['1']));
    expect([again.futures.get('2'), again.driving.has('2'), again.answering.size]).toEqual([own.futures, true, 0]);
    // Its earlier motion is unknown: it keeps the current one.
    const unknown = { ...set, answering: new Map([['2', { said }]]) };
    expect(thoseWhoAnswer(there, unknown, ['1'])).toEqual(new Set());
  });

  it('undone and repeated reports the reactions again', () => {
    pick(2);
    generator.last.on.final(finalWith({ '2': late('2', 3, '1') }), 5);
    const changed = editor.answers.changes.peek();
    expect(changed).toHaveLength(1);
    editor.commits.undo();
    expect(editor.answers.changes.peek()).toEqual([]);
    const asked = generator.asked.filter((q) => !q.preview).length;
    pick(2);
    expect(editor.answers.changes.peek()).toEqual(changed);
    expect(generator.asked.filter((q) => !q.preview)).toHaveLength(asked);
  });

  it('leaves earlier picks unchanged', () => {
    pick(2);
    generator.last.on.final(finalWith({}), 5);
    editor.select('2');
    generator.last.on.final(finalOf('2'), 5);
    pick(1);
    const { react, agents, pinned } = generator.last.options;
    expect([agents, pinned]).toEqual([['2'], ['2']]);
    expect(react).not.toContain('1');
    expect(react).not.toContain('2');
    expect(react).toContain('3');
    // Late arrivals brake too.
    const scene = editor.scene.peek()!;
    const third = scene.agents.get('3')!;
    const comesAt = (step: number) =>
      withAgents(scene, [{ ...third, logStart: null, log: { ...third.log, valid: [[step, step + 30]] } }]);
    const step = { name: '', agent: '2', undo: false };
    expect(requestForChange(editor, comesAt(20), step)).toMatchObject({
      react: expect.arrayContaining(['3']) as unknown,
    });
    expect(requestForChange(editor, comesAt(120), step)).not.toMatchObject({
      react: expect.arrayContaining(['3']) as unknown,
    });
  });
});

describe('a scene that gets longer', () => {
  it('continues: none is drawn again, with or without conditions', () => {
    editor.commits.run(setLength(editor.scene.peek()!, 15));
    rest();
    expect(generator.last.options).toMatchObject({ agents: [], react: true, horizon_s: 15 });
    goalFor('1');
    rest();
    expect(generator.last.options).toMatchObject({ agents: ['1'], react: true });
    generator.last.on.final(finalOf('1'), 5);
    editor.commits.run(setLength(editor.scene.peek()!, 20));
    rest();
    expect(generator.last.options).toMatchObject({ agents: [], react: true, horizon_s: 20 });
    // Another seed draws again.
    editor.commits.run(setSeed(7));
    rest();
    expect(generator.last.options).toMatchObject({ agents: ['1'], react: true, seed: 7 });
  });
});

describe('another seed', () => {
  it('draws all conditioned ones again, except those with a picked future', () => {
    for (const id of ['1', '2']) {
      goalFor(id);
      rest();
      generator.last.on.final(finalOf(id), 5);
    }
    editor.commits.run(setSeed(7));
    rest();
    expect(generator.last.options).toMatchObject({ agents: ['1', '2'], seed: 7 });
    generator.last.on.final(finalOf('1', '2'), 5);
    editor.select('1');
    editor.commits.run(pickFuture(editor, editor.agent.peek()!, 2)!);
    rest();
    generator.last.on.final(finalOf('1'), 5);
    editor.commits.run(setSeed(8));
    rest();
    expect(generator.last.options).toMatchObject({ agents: ['2'], seed: 8 });
  });
});

describe('a road user with only one future', () => {
  it('is offered five others beside it when it is selected, and keeps its motion', () => {
    goalFor('1');
    rest();
    generator.last.on.final(answered('1', { '2': late('2', 3, '1') }), 5);
    const way = editor.answers.motion.peek().futures.get('2')!.modes[0].motion;
    editor.select('2');
    expect(generator.last.options).toMatchObject({ agents: ['2'], react: true });
    generator.last.on.final(finalOf('2'), 5);
    const { modes, chosen } = editor.reading.futures.peek()!;
    expect([modes.length, chosen, modes[0].motion === way]).toEqual([6, 0, true]);
    expect(new Set(modes.map((m) => m.name)).size).toBe(6);
    const asked = generator.asked.length;
    editor.select('1');
    editor.select('2');
    expect(generator.asked.length).toBe(asked);
  });
});

describe('an unreachable generator', () => {
  it('is retried, and then gets the waiting requests', async () => {
    editor.select('1');
    goalFor('1');
    rest();
    generator.there = false;
    generator.last.on.away();
    expect(editor.answers.away.peek()).toEqual({ retryIn: 1, waiting: 1 });
    expect(editor.reading.futures.peek()?.sketch).toBe(true);
    const asked = generator.asked.length;
    goalFor('2');
    expect(editor.answers.away.peek()?.waiting).toBe(2);
    await vi.advanceTimersByTimeAsync(1000);
    expect([editor.answers.away.peek()?.retryIn, generator.asked.length]).toEqual([2, asked]);
    generator.there = true;
    await generation.tryNow();
    expect(editor.answers.away.peek()).toBeNull();
    expect(generator.asked.length).toBe(asked + 1);
    expect(editor.notices.toast.peek()?.text).toBe('The generator is back. 2 changes computed.');
  });
});

describe('a drag', () => {
  it('sends the same surroundings as the same object, which is serialised once', () => {
    goalFor('1');
    rest();
    generator.last.on.final(finalOf('1'), 5);
    editor.select('2');
    generation.preview('2');
    const first = generator.last.scene();
    generation.preview('2');
    expect(generator.last.scene()).toEqual(first);
    expect((generator.last.scene() as { scene: unknown }).scene).toBe((first as { scene: unknown }).scene);
    // Road users off their recording are sent with their one followed future.
    const { generated } = (first as { scene: SceneJson }).scene;
    expect(generated?.samples[0].agents['1']).toMatchObject({ chosen: 0, modes: [{ probability: 0.41 }] });
  });
});

describe('the shown future of a drag', () => {
  const judgedSix = judged(six('1').modes as ModeJson[], ['2', '17']);
  /** The six in another order of probability, as received: the likeliest first. */
  const sent = (order: string, chosen: number): AgentFuturesJson => ({
    chosen,
    modes: [...order].map((letter, i) => ({ ...judgedSix['ABCDEF'.indexOf(letter)], probability: 0.3 - 0.04 * i })),
  });
  const draft = (a: AgentFuturesJson) => ({ event: 'step', window: 0, agents: { '1': a } }) as unknown as DraftEvent;
  const final = (a: AgentFuturesJson) => ({ ...finalOf(), samples: [{ agents: { '1': a } }] }) as unknown as FinalEvent;
  const names = () => editor.reading.futures.peek()!.modes.map((m) => m.name);
  const anchors = () => editor.reading.futures.peek()!.modes.map((m) => m.anchor);
  const goal = (x: number) => {
    const a = editor.scene.peek()!.agents.get('1')!;
    return setGoal(a, { ...a.goal, pos: [x, 10] });
  };

  beforeEach(() => {
    editor.commits.run(setOthers('log'));
    rest();
    editor.select('1');
    generator.last.on.final(final(sent('ABCDEF', 0)), 5);
  });

  const dragTo = (x: number) => {
    if (!editor.drag.active.peek()) editor.drag.begin({ part: 'goal', handle: 'body' });
    editor.drag.preview(goal(x));
    generation.preview('1');
  };

  it('is sent with the frames of a drag, and with nothing else', () => {
    expect(generator.last.options.shown).toBeUndefined();
    dragTo(10);
    const { x_m, y_m, anchor } = generator.last.options.shown!['1'];
    expect([anchor, x_m.length, y_m.length]).toEqual([0, 18, 18]);
    expect(x_m[0]).toBeCloseTo(judgedSix[0].x_m[4], 3);
    generator.last.on.draft(draft(sent('BACDEF', 0)), 5, 5, 10);
    editor.drag.end(goal(10));
    rest();
    expect(generator.last.options.score).toBe(true);
    // The release follows from the document alone, as a typed goal does.
    expect(generator.last.options.shown).toBeUndefined();
    generator.last.on.final(final(sent('BACDEF', 0)), 5);
    dragTo(15);
    expect(generator.last.options).toMatchObject({ score: false, shown: { '1': { anchor: 1 } } });
    editor.drag.cancel();
    editor.commits.run(goal(20));
    rest();
    expect(generator.last.options.shown).toBeUndefined();
  });

  it('keeps letters and names with their ideas until rest, and then ranks them', () => {
    const before = names();
    dragTo(10);
    const swapped = sent('FEDCBA', 5);
    generator.last.on.draft(draft(swapped), 1, 5, 10);
    expect([anchors(), names()]).toEqual([[0, 1, 2, 3, 4, 5], before]);
    generator.last.on.final(final(swapped), 12);
    expect([anchors(), names()]).toEqual([[0, 1, 2, 3, 4, 5], before]);
    expect(editor.reading.chosen.peek()).toBe(0);
    editor.drag.end(goal(10));
    rest();
    generator.last.on.draft(draft(swapped), 5, 5, 10);
    expect(anchors()).toEqual([0, 1, 2, 3, 4, 5]);
    generator.last.on.final(final(swapped), 12);
    expect(anchors()).toEqual([5, 4, 3, 2, 1, 0]);
    const chances = editor.reading.futures.peek()!.modes.map((m) => m.probability);
    expect(chances).toEqual([...chances].sort((a, b) => b - a));
    // The bold one is the same, under its new letter, which is not that of the likeliest.
    expect(editor.reading.futures.peek()!.modes[editor.reading.chosen.peek()].anchor).toBe(0);
    expect(editor.answers.remark.peek()?.words).toBe('F is shown: lower total cost than A, the most likely.');
  });

  it('has the names of rest while the drag pauses', () => {
    dragTo(10);
    const ahead = judgedSix.map((m) => ({ ...m, relations: [], manoeuvre: 'straight' as const }));
    generator.last.on.draft(draft({ chosen: 0, modes: ahead as ModeJson[] }), 5, 5, 10);
    const moving = names();
    vi.advanceTimersByTime(300);
    expect(names()).toEqual(moving);
    vi.advanceTimersByTime(300);
    const f = editor.reading.futures.peek()!;
    const who = { onFoot: false, nameOf: nameIn(editor.scene.peek()!) };
    expect(names()).toEqual(nameAll(f.modes, who).map((n) => n.name));
    expect(names()).not.toEqual(moving);
  });

  it('reports why another is shown than in the drag, until the next one', () => {
    dragTo(10);
    generator.last.on.draft(draft(sent('ABCDEF', 0)), 5, 5, 10);
    editor.drag.end(goal(10));
    rest();
    const hits = judged(six('1').modes as ModeJson[], ['2', '17'], true);
    generator.last.on.final(final({ chosen: 2, modes: hits }), 12);
    expect(editor.answers.remark.peek()).toEqual({
      id: '1',
      words: 'C is shown: A hits Car 2; B has a higher total cost.',
    });
    expect(editor.notices.toast.peek()?.text).toBe('Goal of Car 1 moved.');
    dragTo(20);
    expect(editor.answers.remark.peek()).toBeNull();
  });

  it('stays that of the preview when an answer for an earlier place of the flag arrives later', async () => {
    editor.commits.run(setOthers('react'));
    rest();
    dragTo(10);
    const own = generator.last;
    own.on.final(final(sent('BACDEF', 0)), 12);
    await Promise.resolve();
    dragTo(20);
    const earlier = generator.last;
    dragTo(10);
    const chances = () => editor.reading.futures.peek()!.modes.map((m) => m.probability);
    others.last.on.final(final(sent('FBACDE', 2)), 20);
    const previewed = chances();
    earlier.on.draft(draft(sent('CDEFAB', 0)), 5, 5, 10);
    earlier.on.final(final(sent('CDEFAB', 0)), 12);
    expect(chances()).toEqual(previewed);
    // The flag has moved: the drag's own answers are shown again.
    dragTo(25);
    generator.last.on.final(final(sent('CDEFAB', 0)), 12);
    expect(chances()).not.toEqual(previewed);
  });

  it('has equal names in the drag and at rest, whatever its letter', async () => {
    editor.commits.run(setOthers('react'));
    rest();
    dragTo(10);
    generator.last.on.final(final(sent('BACDEF', 0)), 12);
    await Promise.resolve();
    others.last.on.final(final(sent('FEDCBA', 2)), 20);
    vi.advanceTimersByTime(1000);
    const named = () => Object.fromEntries(editor.reading.futures.peek()!.modes.map((m) => [String(m.anchor), m.name]));
    const [letters, inTheDrag] = [anchors(), named()];
    editor.drag.end(goal(10));
    rest();
    expect(anchors()).not.toEqual(letters);
    expect(named()).toEqual(inTheDrag);
  });

  it('is taken over from the preview, ranked and explained', async () => {
    editor.commits.run(setOthers('react'));
    rest();
    dragTo(10);
    generator.last.on.draft(draft(sent('BACDEF', 0)), 5, 5, 10);
    generator.last.on.final(final(sent('BACDEF', 0)), 12);
    await Promise.resolve();
    expect(others.last.options.react).toBe(true);
    expect(others.last.options.shown).toBeUndefined();
    others.last.on.final(final(sent('FBACDE', 2)), 20);
    editor.drag.end(goal(10));
    rest();
    expect(anchors()).toEqual([5, 1, 0, 2, 3, 4]);
    expect(editor.answers.remark.peek()?.words).toBe('C is shown; B was shown in the drag.');
  });
});
