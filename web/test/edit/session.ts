// An editing session without a page or a server: its generators are in the test.
import { expect } from 'vitest';
import { localReach } from '../../src/model/words/reach-words';
import { SpeedCurve } from '../../src/edit/tools/speed-curve/speed-curve';
import { Editor } from '../../src/edit/session/editor';
import { Generation } from '../../src/edit/asking/generation';
import { Journal } from '../../src/edit/document/journal';
import { SceneFile } from '../../src/edit/document/scene-file';
import { SceneList } from '../../src/edit/document/scene-list';
import { Saving } from '../../src/edit/document/saving';
import { Client } from '../../src/net/client';
import { PassingStepStore } from '../../src/net/step-store';
import type { Generator, Question, SceneRef, Trajectories } from '../../src/net/generator';
import type { DraftEvent, FinalEvent, ScoreReply } from '../../src/net/types';
import { isMapRef, type AgentFuturesJson, type MapJson } from '../../src/model/document/scene-json';
import { readScene } from '../../src/model/document/scene-reader';
import { crossingJson } from '../helpers';
import { giveWay, reactionTo, sixFutures } from '../standin/futures.mjs';

/** An empty score; the editor reads nothing else. */
export const uneventful = {
  scene: { collisions: [], near_misses: [], min_ttc_s: null, offroad_share: null },
} as unknown as ScoreReply;

/** Road users whose start, goal or via points the server refuses, as they would change no motion. */
function refusedConditions({ options, scene }: Question): string[] {
  const { agents, conditions } = options;
  if (agents === 'all') return [];
  const sent = scene();
  const kept = 'scene' in sent ? Object.keys(sent.scene.generated?.samples[0].agents ?? {}) : [];
  const counts = new Set([...agents, ...kept]);
  const moves = Object.entries(conditions).filter(([, c]) => c.start || c.goal || c.via);
  return moves.map(([id]) => id).filter((id) => !counts.has(id));
}

/** Collects the questions; the test answers them at any time. */
export class InMemoryGenerator implements Generator {
  readonly asked: Question[] = [];
  readonly scored: { scene: SceneRef; ids: string[] }[] = [];
  cancelled = 0;
  there = true;

  ask(q: Question): void {
    expect(refusedConditions(q)).toEqual([]);
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

export const json = crossingJson();
const agentOf = (id: string) => json.agents.find((a) => a.id === id)!;
export const six = (id: string): AgentFuturesJson => ({ chosen: 0, modes: sixFutures(agentOf(id), undefined, 5, 5) });

/** A road user delayed by this many seconds, with a reaction where `cause` is given. */
export function late(id: string, seconds: number, cause?: string): AgentFuturesJson {
  const mode = giveWay(agentOf(id), seconds);
  return { chosen: 0, modes: [mode], ...(cause ? { reaction: reactionTo(cause, mode, seconds) } : {}) };
}

export const draftOf = (...ids: string[]) =>
  ({ event: 'step', window: 0, agents: Object.fromEntries(ids.map((id) => [id, six(id)])) }) as unknown as DraftEvent;

export const finalWith = (agents: Record<string, AgentFuturesJson>) =>
  ({
    event: 'final',
    samples: [{ agents }],
    resolved: {},
    scores: [uneventful],
    warnings: [],
  }) as unknown as FinalEvent;

export const finalOf = (...ids: string[]) => finalWith(Object.fromEntries(ids.map((id) => [id, six(id)])));

/** The selected one has its six, and others react to it. */
export const answered = (id: string, others: Record<string, AgentFuturesJson>) =>
  finalWith({ [id]: six(id), ...others });

export class Session {
  readonly editor = new Editor();
  readonly curve = new SpeedCurve(this.editor);
  readonly generator = new InMemoryGenerator();
  /** The generator of the reaction previews. */
  readonly others = new InMemoryGenerator();
  readonly generation: Generation;

  constructor() {
    const { editor } = this;
    editor.reading.layReach(localReach);
    const file = new SceneFile(editor);
    const client = new Client('', () => Promise.reject(new Error('nothing is fetched here')));
    const saving = new Saving(
      editor.document,
      file,
      new SceneList(client),
      client,
      new Journal(new PassingStepStore()),
    );
    this.generation = new Generation(editor, file, saving, this.generator, this.others, (id, joins) =>
      this.curve.takeUp(id, joins),
    );
    file.adopt(json, isMapRef(json.map) ? ({} as MapJson) : json.map, true);
    editor.open(readScene(json));
  }
}
