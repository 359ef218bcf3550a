// Rounds of cards: requests, undo, ends, and the state after taking a card.
import { describe, expect, it } from 'vitest';
import { setGoal } from '../../src/model/document/commands';
import { reasons } from '../../src/model/words/feedback-words';
import { readScene } from '../../src/model/document/scene-reader';
import { sceneKey } from '../../src/model/document/scene';
import { writeScene } from '../../src/model/document/scene-writer';
import { Deck } from '../../src/edit/tools/rounds/deck';
import { RequestBuilder } from '../../src/edit/asking/request-builder';
import { Rounds } from '../../src/edit/tools/rounds/rounds';
import { pickFuture } from '../../src/edit/moves/moves';
import { SceneFile } from '../../src/edit/document/scene-file';
import type { FinalEvent, Problem } from '../../src/net/types';
import { finalOf, InMemoryGenerator, json, late, Session, six, uneventful } from './session';

const ID = '1';

class Table extends Session {
  readonly cards = new InMemoryGenerator();
  readonly deck = new Deck(this.editor.scene);
  readonly rounds: Rounds;

  constructor() {
    super();
    this.editor.reading.layCards(this.deck);
    const file = new SceneFile(this.editor);
    file.adopt(json, {} as never, true);
    this.rounds = new Rounds(this.editor, this.deck, new RequestBuilder(this.editor, file), this.cards);
    this.editor.select(ID);
    this.generator.last.on.final(finalOf(ID), 10);
  }

  get agent() {
    return this.editor.agent.peek()!;
  }

  get feedback() {
    return this.cards.last.options.feedback!;
  }

  /** Six cards; those of another round are elsewhere. */
  deal(shift = 0, wishes: readonly unknown[] = []): void {
    const cards = six(ID).modes.map((m, i) => ({
      features: { pace_mps: 5, gap_s: 2, harshness_mps2: i + shift, standing_s: 0 },
      places: { [ID]: [0, 1].map((t) => [m.x_m[t] + shift, m.y_m[t] + i * 3]) },
    }));
    const e = { ...finalOf(ID), feedback: { cards, wishes } } as unknown as FinalEvent;
    this.cards.last.on.final(e, 20);
  }

  /** Three scenes of two road users; in each of them one is a second later than in the one before. */
  dealScenes(): void {
    const samples = [0, 1, 2].map((n) => ({ agents: { [ID]: late(ID, n + 1), 2: late('2', n + 2) } }));
    const cards = samples.map(({ agents }, n) => ({
      features: { pace_mps: 5, gap_s: 2, harshness_mps2: n, standing_s: 0 },
      places: { [ID]: [0, 1].map((t) => [agents[ID].modes[0].x_m[t], n * 3]) },
    }));
    const e = { ...finalOf(ID), samples, scores: samples.map(() => uneventful), feedback: { cards, wishes: [] } };
    this.cards.last.on.final(e as unknown as FinalEvent, 20);
  }

  /** Key of a reason, by its words. */
  keyOf(words: string): string {
    const { features } = this.deck.hand.peek()!.round.cards[0];
    return reasons(ID, features, 'reject', () => null).find((r) => r.words === words)!.key;
  }

  get letters(): string {
    return this.rounds.said
      .peek()
      .map((s) => (s ? s.verdict[0] : '.'))
      .join('');
  }
}

describe('rounds', () => {
  it('request one road user without reactions, and leave its motion unchanged', () => {
    const t = new Table();
    const before = t.editor.answers.motion.peek();
    t.rounds.open();
    const { options } = t.cards.last;
    expect([options.agents, options.react]).toEqual([[ID], false]);
    expect(t.feedback).toEqual({ answers: [], wishes: [], forgotten: [] });
    t.deal();
    expect(t.editor.reading.futures.peek()).toBe(t.deck.ofAgent(ID)!.futures);
    expect(t.editor.answers.motion.peek()).toBe(before);
    t.deck.point(3);
    expect(t.editor.reading.chosen.peek()).toBe(3);
    expect(t.editor.reading.motionFor(t.agent)).toBe(t.editor.reading.futures.peek()!.modes[3].motion);
    // Code that follows a pick must not take them for futures.
    expect(pickFuture(t.editor, t.agent, 2)).toBeNull();
    t.rounds.close();
    expect(t.editor.reading.futures.peek()).toBe(before.futures.get(ID));
  });

  it('wait for the answer to a change, and do not cancel it', () => {
    const t = new Table();
    t.editor.commits.run(setGoal(t.agent, { ...t.agent.goal, pos: [10, 10] }));
    expect(t.editor.answers.motion.peek().stale).toBe(true);
    t.rounds.openScene();
    expect([t.cards.cancelled, t.cards.asked.length]).toEqual([0, 0]);
    t.editor.answers.settle(t.editor.scene.peek()!, { ...t.editor.answers.motion.peek(), stale: false }, null);
    expect(t.cards.asked).toHaveLength(1);
  });

  it('are undone one statement at a time, without a new request', () => {
    const t = new Table();
    t.rounds.open();
    t.deal();
    t.rounds.next();
    expect(t.editor.document.undoName.peek(), 'nothing new to go on from').toBeNull();
    t.rounds.say(0, 'keep');
    t.rounds.say(2, 'reject');
    t.rounds.sayWhy(4, t.keyOf('too harsh'));
    expect(t.letters).toBe('k.r.r.');
    expect(t.agent.feedback!.answers.at(-1)!.why).toEqual({ trait: 'harshness', wants: 'less' });
    expect(t.cards.asked).toHaveLength(1);
    t.rounds.next();
    expect(t.cards.asked).toHaveLength(2);
    expect(t.feedback.answers).toHaveLength(3);
    // Cards of the round before cannot be judged while the next ones are drawn.
    t.rounds.say(1, 'keep');
    expect(t.agent.feedback!.answers).toHaveLength(3);
    t.deal(50);
    expect(t.letters).toBe('......');
    t.editor.commits.undo();
    expect(t.letters).toBe('k.r.r.');
    t.editor.commits.undo();
    expect(t.letters).toBe('k.r...');
    t.editor.commits.redo();
    t.editor.commits.redo();
    expect(t.letters).toBe('......');
    expect(t.deck.hand.peek()!.asked.round).toBe(2);
    expect(t.cards.asked).toHaveLength(2);
  });

  it('show learned preferences except forgotten ones, and new preferences since', () => {
    const t = new Table();
    t.rounds.open();
    const smooth = { trait: 'harshness', wants: 'less', strength: 0.6, said: false, against: [] };
    t.deal(0, [smooth]);
    const words = () => t.rounds.wished.peek().map((w) => w.words);
    expect(words()).toEqual(['Smoother']);
    t.rounds.wish({ trait: 'pace', wants: 'more' });
    expect(words()).toEqual(['Smoother', 'Faster']);
    t.rounds.forget(t.rounds.wished.peek()[0]);
    expect(words()).toEqual(['Faster']);
    t.editor.commits.undo();
    expect(words()).toEqual(['Smoother', 'Faster']);
    t.rounds.forgetAll();
    expect(words()).toEqual([]);
    expect(t.agent.feedback!.forgotten).toEqual([{ trait: 'harshness' }, { trait: 'pace' }]);
    t.editor.commits.undo();
    expect(words()).toEqual(['Smoother', 'Faster']);
    t.rounds.next();
    expect(t.feedback.wishes).toEqual([{ trait: 'pace', wants: 'more' }]);
  });

  it.each<[string, (t: Table) => void]>([
    ['somebody else is selected', (t) => t.editor.select('2')],
    ['the goal moves', (t) => t.editor.commits.run(setGoal(t.agent, { ...t.agent.goal, pos: [10, 3] }))],
    ['a handle is dragged', (t) => t.editor.drag.begin({ part: 'goal', handle: 'body' })],
    ['the tab loses its turn', (t) => t.editor.lockWith({ words: '', label: '', run: () => undefined })],
  ])('end when %s; what was said stays', (_, change) => {
    const t = new Table();
    t.rounds.open();
    t.deal();
    t.rounds.say(0, 'keep');
    change(t);
    expect(t.rounds.isOpen.peek()).toBe(false);
    expect(t.deck.hand.peek()).toBeNull();
    expect(t.editor.scene.peek()!.agents.get(ID)!.feedback!.answers).toHaveLength(1);
  });

  it('report why there are no cards, and retry on demand', () => {
    const t = new Table();
    t.rounds.open();
    t.cards.last.on.refused({ code: 'http-500', title: 'Too much is asked' } as Problem);
    expect(t.deck.problem.peek()).toBe('Too much is asked');
    t.rounds.tryAgain();
    expect(t.deck.asking.peek()).toBe(true);
    t.cards.last.on.away();
    expect(t.deck.problem.peek()).toBe('The generator is not answering.');
    t.rounds.tryAgain();
    t.deal();
    expect(t.deck.problem.peek()).toBeNull();
    expect(t.letters).toBe('......');
  });

  it('do not open in a read-only tab', () => {
    const t = new Table();
    t.editor.lockWith({ words: 'Open in another tab', label: 'Take over', run: () => undefined });
    t.rounds.open();
    expect(t.rounds.isOpen.peek()).toBe(false);
    expect(t.editor.notices.toast.peek()?.text).toBe('Open in another tab');
  });

  it('end with a taken card: others react to it as to a pick, and undo restores the usual six', () => {
    const t = new Table();
    const usual = t.editor.answers.motion.peek();
    t.rounds.open();
    t.deal();
    const { futures } = t.deck.ofAgent(ID)!;
    t.rounds.take(2);
    expect(t.rounds.isOpen.peek()).toBe(false);
    expect(t.agent.chosen).toBe(2);
    expect(t.editor.reading.futures.peek()).toBe(futures);
    const key = sceneKey(t.editor.scene.peek()!);
    t.editor.commits.undo();
    expect(t.editor.answers.motion.peek()).toBe(usual);
    // The same letter among the usual six is another document.
    t.editor.commits.run(pickFuture(t.editor, t.agent, 2)!);
    expect(sceneKey(t.editor.scene.peek()!)).not.toBe(key);
  });

  describe('of the whole scene', () => {
    const sets = (t: Table) => {
      const { hand } = t.deck;
      const now = hand.peek();
      return now?.id === null ? now.sets : [];
    };

    it("request all road users, and show a card's motions without a change", () => {
      const t = new Table();
      const before = t.editor.answers.motion.peek();
      t.rounds.openScene();
      expect([t.cards.last.options.agents, t.cards.last.options.react]).toEqual(['all', false]);
      t.dealScenes();
      expect(sets(t)).toHaveLength(3);
      expect(t.editor.answers.motion.peek()).toBe(before);
      // Cards of one road user are not in use here.
      expect(t.editor.reading.futures.peek()).toBe(before.futures.get(ID));
      t.deck.point(2);
      expect(t.editor.reading.motionFor(t.agent)).toBe(sets(t)[2].futures.get(ID)!.modes[0].motion);
      t.editor.select('2');
      expect(t.rounds.isOpen.peek(), 'whoever is looked at').toBe(true);
      t.rounds.close();
      expect(t.editor.answers.motion.peek()).toBe(before);
    });

    it('store feedback with the scene, apart from that of one road user', () => {
      const t = new Table();
      t.rounds.openScene();
      t.dealScenes();
      t.rounds.say(0, 'keep');
      t.rounds.say(1, 'reject');
      expect(t.letters).toBe('kr.');
      expect(t.agent.feedback).toBeNull();
      expect(t.editor.document.undoName.peek()).toBe('Card B rejected, the whole scene');
      const scene = t.editor.scene.peek()!;
      const file = writeScene(json, scene, null);
      expect(readScene(JSON.parse(JSON.stringify(file))).feedback).toEqual(scene.feedback);
      t.rounds.next();
      expect(t.feedback.answers!.map((a) => a.verdict)).toEqual(['keep', 'reject']);
      t.editor.commits.undo();
      t.editor.commits.undo();
      t.editor.commits.undo();
      expect(t.editor.scene.peek()!.feedback).toBeNull();
    });

    it('end with a taken card, which all road users follow, and undo takes it back', () => {
      const t = new Table();
      const before = t.editor.answers.motion.peek();
      t.rounds.openScene();
      t.dealScenes();
      const taken = sets(t)[1];
      const asked = () => t.generator.asked.filter((q) => !q.preview).length;
      const known = asked();
      t.rounds.take(1);
      expect(t.rounds.isOpen.peek()).toBe(false);
      expect(t.editor.answers.motion.peek().futures).toBe(taken.futures);
      expect([...t.editor.answers.motion.peek().driving].sort()).toEqual([ID, '2']);
      expect(asked(), 'it is known what comes of it').toBe(known);
      t.editor.commits.undo();
      expect(t.editor.answers.motion.peek()).toBe(before);
      t.editor.commits.redo();
      expect(t.editor.answers.motion.peek().futures).toBe(taken.futures);
    });

    it('give every kept card as a document of its own', () => {
      const t = new Table();
      t.rounds.openScene();
      t.dealScenes();
      t.rounds.say(0, 'keep');
      t.rounds.say(2, 'keep');
      const kept = t.rounds.kept();
      const takes = kept && !('futures' in kept) ? kept : [];
      expect(takes).toHaveLength(2);
      expect(new Set(takes.map((k) => sceneKey(k.scene))).size).toBe(2);
      for (const { scene, set } of takes) expect(set.key).toBe(sceneKey(scene));
    });
  });
});
