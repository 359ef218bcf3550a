// The generator interface of the editor, and the editor's only access to it: today the server (`http-generator.ts`), in
// a test or later an engine in the page.
import type { SceneJson } from '../model/document/scene-json';
import type { DraftEvent, FinalEvent, GenerateOptions, Problem, ScoreReply } from './types';

/** A scene by its name on the server, or itself. An object sent twice is serialised once. */
export type SceneRef = { readonly id: string } | { readonly scene: SceneJson };

export interface Question {
  /** The scene of the question; created when it is sent, which a newer one may prevent. */
  scene(): SceneRef;
  /** The same with the map inside, for a generator without the map. */
  whole(): SceneJson;
  readonly options: GenerateOptions;
  /** A preview may be dropped for a newer one; a commit is sent at once. */
  readonly preview: boolean;
  readonly on: Handlers;
}

/** Ends of a question: exactly one of `final`, `refused`, `away` and `dropped` is called. */
export interface Handlers {
  draft(e: DraftEvent, step: number, steps: number, ms: number): void;
  final(e: FinalEvent, ms: number): void;
  refused(p: Problem): void;
  away(): void;
  /** No result for a while; repeated while it lasts, with the time since the question. */
  slow?(ms: number): void;
  /** The question ended without an answer because a newer one replaced it. */
  dropped?(): void;
}

/** Thresholds of a score that differ from the usual ones. */
export type Counting = { readonly thresholds?: Record<string, number> };

/** Motions to score, by road user; all others move as in the scene. */
export type Trajectories = Readonly<Record<string, unknown>>;

export interface Generator {
  /** The newest question wins: one under way, one waiting. */
  ask(question: Question): void;
  /** Cancels all questions. */
  cancel(): void;
  /** Collisions and near misses of known motions. */
  score(scene: SceneRef, trajectories: Trajectories, what: Counting, signal: AbortSignal): Promise<ScoreReply>;
  /** Does the generator answer? */
  answers(): Promise<boolean>;
}
