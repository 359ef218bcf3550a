// Outcomes of an event's remedies are known before one is taken: each is tried separately, without a change.
import { describe, expect, it } from 'vitest';
import type { TrafficEvent } from '../../src/model/words/event-words';
import { eventRemedies } from '../../src/edit/moves/event-remedies';
import { RequestBuilder } from '../../src/edit/asking/request-builder';
import { SceneFile } from '../../src/edit/document/scene-file';
import { WhatIf } from '../../src/edit/asking/what-if';
import { RemedyOutcomes } from '../../src/edit/asking/remedy-outcomes';
import type { FinalEvent } from '../../src/net/types';
import { finalOf, InMemoryGenerator, json, Session, six } from './session';

class Weighed extends Session {
  readonly line = new InMemoryGenerator();
  readonly whatIf: WhatIf;
  readonly outcomes: RemedyOutcomes;
  readonly end: () => void;
  readonly event: TrafficEvent;

  constructor() {
    super();
    const file = new SceneFile(this.editor);
    file.adopt(json, {} as never, true);
    this.whatIf = new WhatIf(this.editor, new RequestBuilder(this.editor, file), this.line, file);
    this.outcomes = new RemedyOutcomes(this.editor, this.whatIf);
    this.end = this.outcomes.begin();
    const [a, b] = ['1', '2'].map((id) => this.editor.scene.peek()!.agents.get(id)!);
    const words = { title: '', label: '', words: '', short: '', facts: [] };
    this.event = {
      ...words,
      kind: 'near',
      what: 'near_miss',
      time: 4,
      until: 5,
      gap: 0.6,
      a,
      b,
      inLog: false,
      at: [0, 0],
      extent: 0.6,
      ttc: null,
      poses: [null, null],
    };
    this.editor.pickEvent(this.event);
  }

  get ways() {
    return eventRemedies(this.editor, this.event);
  }

  get marks() {
    return this.ways.map((w) => this.outcomes.of(w)?.mark);
  }

  answer(...hit: [string, string][]): void {
    const collisions = hit.map(([a, b]) => ({ a, b, time_s: 3 }));
    const scene = { collisions, near_misses: [], min_ttc_s: null, offroad_share: null };
    this.line.last.on.final(
      {
        ...finalOf('1'),
        samples: [{ agents: { 1: six('1') } }],
        scores: [{ scene }],
      } as unknown as FinalEvent,
      5,
    );
  }
}

describe('remedies of an event', () => {
  it('report whether the event is gone, remains, or is replaced by another', () => {
    const t = new Weighed();
    const scene = t.editor.scene.peek();
    const [first, second] = t.ways;
    expect([t.ways.length >= 2, t.whatIf.asking.peek()]).toEqual([true, true]);
    expect(t.marks.every((m) => m === undefined)).toBe(true);
    t.answer(['1', '3']);
    expect(t.outcomes.of(first)).toMatchObject({
      mark: 'collision',
      words: expect.stringMatching(/^New: Car/) as unknown,
    });
    t.answer(['1', '2']);
    expect(t.outcomes.of(second)?.words).toMatch(/^Still: Collision/);
    while (t.whatIf.asking.peek()) t.answer();
    expect(t.line.asked).toHaveLength(t.ways.length);
    expect([t.editor.scene.peek(), t.editor.document.undoName.peek()]).toEqual([scene, null]);
  });

  it('are good where no event remains', () => {
    const t = new Weighed();
    t.answer();
    expect(t.outcomes.of(t.ways[0])).toEqual({ mark: 'ok', words: 'Event avoided' });
  });

  it('are tried again for another event; a late answer is ignored', () => {
    const t = new Weighed();
    const { on } = t.line.last;
    t.editor.pickEvent({ ...t.event, time: 6 });
    expect([t.line.cancelled, t.line.asked.length]).toEqual([1, 2]);
    on.final(finalOf('1'), 5);
    expect([t.marks[0], t.line.asked.length]).toEqual([undefined, 2]);
    t.end();
    expect(t.whatIf.asking.peek()).toBe(false);
  });
});
