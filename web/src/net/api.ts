// The HTTP API as the editor uses it. What the editor does, a script can do: nothing here is private.
import type { AgentFuturesJson, ConditionJson, SampleJson, SceneJson } from '../model/json';

export interface SceneListItem {
  id: string; name: string; etag?: string; updated_at?: string;
  counts?: { vehicle?: number; pedestrian?: number; cyclist?: number; other?: number };
  map_sha256?: string | null; source?: string | null; licence?: string | null; bytes?: number; readonly?: boolean;
}
export interface SceneList { scenes: SceneListItem[]; next?: string | null }

export interface Problem {
  code: string; title: string; detail?: string; status?: number; etag?: string; updated_at?: string; request_id?: string;
  reason?: string; offset?: number; errors?: { pointer?: string; code?: string; detail?: string; got?: unknown; min?: number; max?: number }[];
}

export interface ImportReply {
  scenes: { id: string; name: string; warnings?: unknown[]; counts?: SceneListItem['counts'] }[];
  skipped?: { index: number; problem: Problem }[];
}

/** Body of POST /v1/generate, without the scene: that part is large and kept as ready-made text. */
export interface GenerateOptions {
  client: string; revision: number; agents: string[] | 'all'; react: boolean | string[]; conditions: Record<string, ConditionJson>;
  seed: number; diversity: number; steps: number; stream_modes: 'all' | 'chosen'; score: boolean;
  /** Seconds to work out, and after how many everybody plans anew from where they are; 9 of each when absent. */
  horizon_s?: number; replan_interval_s?: number;
}

interface EventBase { seq?: number; job?: string; revision?: number; elapsed_ms?: number }
export interface AcceptedEvent extends EventBase { event: 'accepted'; regenerated?: string[]; reacting?: string[]; warnings?: WarningJson[]; steps?: number; windows?: number }
export interface DraftEvent extends EventBase { event: 'initial' | 'step'; window?: number; sample?: number; step?: number; steps?: number; agents: Record<string, AgentFuturesJson> }
export interface ReachJson {
  status?: string; nearest?: { x_m: number; y_m: number; heading_rad?: number; speed_mps?: number } | null;
  limiting?: string | null; needs?: unknown; words?: string | null;
}
export interface ResolvedJson { reach?: ReachJson | null; [field: string]: unknown }
export interface ScoreJson {
  collisions?: { a: string; b: string; time_s: number; iou?: number }[];
  near_misses?: { a: string; b: string; time_s: number; distance_m?: number | null; ttc_s?: number | null }[];
  min_ttc_s?: number | null; offroad_share?: number | null; [k: string]: unknown;
}
export interface ScoreReply { scene: ScoreJson; agents?: Record<string, unknown> }
export interface WarningJson { code?: string; agent?: string; detail?: string; [k: string]: unknown }
export interface FinalEvent extends EventBase {
  event: 'final'; windows?: number; samples: SampleJson[]; resolved?: Record<string, ResolvedJson>; scores?: ScoreReply | ScoreReply[] | null; warnings?: WarningJson[];
  generated?: Record<string, unknown>;
}
export interface ErrorEvent extends EventBase { event: 'error'; problem: Problem }
export interface SupersededEvent extends EventBase { event: 'superseded'; by_revision?: number }
export interface HeartbeatEvent extends EventBase { event: 'heartbeat' }
export type GenerateEvent = AcceptedEvent | DraftEvent | FinalEvent | ErrorEvent | SupersededEvent | HeartbeatEvent;

export type { SceneJson };
