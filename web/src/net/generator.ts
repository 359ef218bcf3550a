// What the editor asks of a generator. The editor knows this interface alone: the server is behind it today
// (`http-generator.ts`), a test or an engine in the page may be.
import type { SceneJson } from '../model/document/scene-json';
import type { DraftEvent, FinalEvent, GenerateOptions, Problem, ScoreReply } from './types';

/** A scene by its name on the server, or itself. The same object asked about twice is written once. */
export type SceneRef = { readonly id: string } | { readonly scene: SceneJson };

export interface Question {
  /** What is asked about; made when the question is put, which a newer one may prevent. */
  scene(): SceneRef;
  /** The same with the map inside, for a generator that does not know the map yet. */
  whole(): SceneJson;
  readonly options: GenerateOptions;
  /** A preview may be dropped for a newer one; a commit is sent at once. */
  readonly preview: boolean;
  readonly on: Handlers;
}

/** How a question ends: with exactly one of `final`, `refused`, `away` and `dropped`. */
export interface Handlers {
  draft(e: DraftEvent, step: number, steps: number, ms: number): void;
  final(e: FinalEvent, ms: number): void;
  refused(p: Problem): void;
  away(): void;
  /** Nothing new for a while; said again while it lasts, with the time since the question. */
  slow?(ms: number): void;
  /** The question ended without an answer because a newer one took its place. */
  dropped?(): void;
}

/** What counts in a score, where that is not as usual. */
export type Counting = { readonly thresholds?: Record<string, number> };

/** Motions to be scored, by road user; all others do as the scene says. */
export type Trajectories = Readonly<Record<string, unknown>>;

export interface Generator {
  /** The newest question wins: one on its way, one waiting. */
  ask(question: Question): void;
  /** Drops everything on its way. */
  cancel(): void;
  /** Collisions and near misses of motions that are known already. */
  score(scene: SceneRef, trajectories: Trajectories, what: Counting, signal: AbortSignal): Promise<ScoreReply>;
  /** Is anybody there? */
  answers(): Promise<boolean>;
}
