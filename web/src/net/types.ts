// The API as the editor uses it: names for parts of the generated document. What the editor does, a script can do:
// nothing here is private.
import type { components } from './api';
import type { AgentFuturesJson, SampleJson, SceneJson } from '../model/json';

type Schemas = components['schemas'];

export type SceneListItem = Schemas['SceneItem'];
export type SceneList = Schemas['SceneList'];
export type ImportReply = Schemas['ImportReply'];

/** A refusal. An answer that came without a problem document gets its status as its code. */
export type Problem = Omit<Partial<Schemas['Problem']>, 'code'> & {
  code: Schemas['Problem']['code'] | `http-${number}`;
  title: string;
  /** Why a file could not be read. By hand: the document does not name it yet. */
  reason?: string;
};

/** Body of POST /v1/generate, without the scene: that part is large and kept as ready-made text. */
export type GenerateOptions = Pick<Schemas['GenerateRequest'], 'horizon_s' | 'replan_interval_s'> &
  Required<
    Pick<
      Schemas['GenerateRequest'],
      'agents' | 'react' | 'conditions' | 'seed' | 'diversity' | 'steps' | 'stream_modes' | 'score'
    >
  >;

/** Futures as the reader of scenes takes them, which is more tolerant than the document. */
type WithFutures<Event> = Omit<Event, 'agents'> & { agents: Record<string, AgentFuturesJson> };
type WithSamples<Event> = Omit<Event, 'samples' | 'scores'> & {
  samples: SampleJson[];
  scores?: ScoreReply[] | null;
};

export type AcceptedEvent = Schemas['AcceptedEvent'] & { event: 'accepted' };
export type DraftEvent = WithFutures<Schemas['DraftEvent']> & { event: 'initial' | 'step' };
export type FinalEvent = WithSamples<Schemas['FinalEvent']> & { event: 'final' };
export type ErrorEvent = Schemas['ErrorEvent'] & { event: 'error' };
export type SupersededEvent = Schemas['SupersededEvent'] & { event: 'superseded' };
export type HeartbeatEvent = Schemas['HeartbeatEvent'] & { event: 'heartbeat'; revision?: number };
export type GenerateEvent = AcceptedEvent | DraftEvent | FinalEvent | ErrorEvent | SupersededEvent | HeartbeatEvent;

export type ResolvedJson = Schemas['Resolved'];

/**
 * The members of a score that the editor shows. By hand, since the document says of collisions and near misses only
 * that they are objects; to be replaced by the generated type once it says more.
 */
export interface ScoreJson {
  collisions?: { a: string; b: string; time_s: number }[];
  near_misses?: { a: string; b: string; time_s: number; distance_m?: number | null; ttc_s?: number | null }[];
  min_ttc_s?: number | null;
  offroad_share?: number | null;
}
export type ScoreReply = Omit<Schemas['ScoreReply'], 'scene'> & { scene: ScoreJson };

export type { SceneJson };
