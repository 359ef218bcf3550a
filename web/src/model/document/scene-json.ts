// The scene document as sent and stored (`dragtraffic.scene`, version 1), and the futures of answers. Members of a
// document that may be missing are optional: the reader is tolerant, the writer is not.
import type { Feedback } from './feedback';
import type { Schemas } from '../base/schemas';

/** A string where the schema lists words: the reader accepts unknown words. */
type Open<T> = T extends string ? string : T;
/** A part of a document for a tolerant reader: the members in `Needed` are present, all others may be absent. */
type Read<T, Needed extends keyof T = never, Own = unknown> = {
  [K in Exclude<keyof T, keyof Own>]?: Open<T[K]>;
} & { [K in Exclude<Needed, keyof Own>]: Open<T[K]> } & Own;

export type PointJson = [number, number] | [number, number, number];
type HasPoints = { points_m: PointJson[] };
export type LaneJson = Read<Schemas['Lane'], 'id', HasPoints>;
export type LineJson = Read<Schemas['RoadLine'], never, HasPoints>;
export type AreaJson = { id?: string; polygon_m: PointJson[]; holes_m?: PointJson[][] };
/** Lists of the schema with the parts that the page reads. */
export interface MapJson {
  lanes?: LaneJson[];
  road_lines?: LineJson[];
  road_edges?: LineJson[];
  crosswalks?: AreaJson[];
  speed_bumps?: AreaJson[];
  driveways?: AreaJson[];
  stop_signs?: Read<Schemas['StopSign'], never, { position_m: PointJson }>[];
  drivable?: AreaJson[];
}
export type MapRef = Schemas['MapRef'];
export type SignalJson = Read<Schemas['Signal'], 'lane', { stop_m?: PointJson | null; states: [number, string][] }>;
export type TrackJson = Read<
  Schemas['Track'],
  'x_m' | 'y_m' | 'heading_rad',
  { valid?: [number, number][]; vx_mps?: number[] | null; vy_mps?: number[] | null }
>;
export type StartJson = Read<Schemas['Start']>;
/** `may_cross`: ids of road edges that the road user may cross. */
export type GoalRelationJson = Schemas['GoalRelation'];
export type GoalJson = Read<Schemas['Goal'], never, { relation?: GoalRelationJson | null }>;
/** A via point. */
export type ViaJson = Schemas['Via'];
export type ConditionJson = Read<
  Omit<Schemas['Conditions'], 'frame'>,
  never,
  { type?: Schemas['Conditions']['type']; length_m?: number; width_m?: number; start?: StartJson; goal?: GoalJson }
>;
export type AgentJson = Read<
  Schemas['Agent'],
  'id' | 'type',
  { length_m: number; width_m: number; track: TrackJson; conditions?: ConditionJson | null }
>;
export type FaultKind = Schemas['FaultKind'];
export type FaultJson = Schemas['Fault'];
export type RelationKind = Schemas['RelationKind'];
export type RelationJson = Schemas['Relation'];
export type Manoeuvre = Schemas['Manoeuvre'];
/** `anchor`: index of the anchor that the future follows; absent for staying at rest. */
export type ModeJson = TrackJson &
  Pick<Schemas['Future'], 'probability' | 'anchor' | 'faults' | 'relations' | 'manoeuvre'> & { name?: string };
/** The last shown future: box centres every 0.5 s, the first 0.5 s after the start. */
export type ShownJson = Schemas['Shown'];
export type ReactionKind = Schemas['ReactionKind'];
/** Why a road user gave up a motion: its cause, and where it waits or is slowest. */
export type ReactionJson = Schemas['Reaction'];
/** `reaction`: absent for requested and for unaffected road users. */
export type AgentFuturesJson = Omit<Schemas['AgentFutures'], 'modes'> & { modes: ModeJson[] };
export type SampleJson = Omit<Schemas['Sample'], 'agents'> & { agents: Record<string, AgentFuturesJson> };
export type GeneratedJson = Read<Schemas['Generated'], never, { samples: SampleJson[] }>;
export type FeaturesJson = Schemas['Features'];
export type LearnedWishJson = Schemas['LearnedWish'];
export type RoundJson = Schemas['Round'];
export type FeedbackDocJson = Schemas['Feedback'];
/** Data of the editor only: the generator's choices are in `generated`, the user's picks here. */
export interface EditorJson {
  seed?: number;
  diversity?: number;
  others?: string;
  length_s?: number;
  replan_s?: number;
  drawn?: number;
  /** Digest of the tracks that a drive has recorded. */
  drive?: string;
  picked?: Record<string, number>;
  /** Drawn speed profiles of picked futures. */
  curves?: Record<string, unknown>;
  /** The round of cards of the picked future. */
  dealt?: Record<string, string>;
  names?: Record<string, string>;
  notes?: Record<string, string>;
  locked?: string[];
  /** Behaviour of single road users when others change. */
  does?: Record<string, string>;
  /** Ids of placed road users, which have no recording. */
  placed?: string[];
  /** Recorded subtypes of road users with a changed one. */
  was?: Record<string, string>;
  variants?: VariantJson[];
  /** Pinned futures, by road user. */
  pins?: Record<string, PinJson[]>;
  /** Feedback on futures, by road user. */
  feedback?: Record<string, Feedback>;
  /** The same for the whole scene. */
  scene_feedback?: Feedback;
  /** Thresholds of events that differ from the usual ones. */
  thresholds?: Record<string, number>;
  /** What lanes with a changed limit or changed users were. */
  lanes_were?: Record<string, LaneRule>;
}
/** Parts of a lane that a scene may change. */
export interface LaneRule {
  readonly speed_limit_mps: number | null;
  readonly type: NonNullable<LaneJson['type']>;
}
/** A pinned future: its motion, and the start and goal it was made for. */
export interface PinJson {
  name: string;
  type: string;
  track: TrackJson;
  conditions: ConditionJson;
}
/** A variant of the scene: its conditions, and its rating. */
export interface VariantJson {
  id: number;
  name?: string;
  kept?: boolean;
  starred?: boolean;
  seed: number;
  diversity: number;
  others: string;
  length_s: number;
  replan_s: number;
  drawn?: number;
  /** Subject of its set of variants; absent for all road users. */
  subject?: string;
  /** Road users of the scene, with their kinds. */
  roster: string;
  conditions?: Record<string, ConditionJson>;
  picked?: Record<string, number>;
  dealt?: Record<string, string>;
  does?: Record<string, string>;
  curves?: Record<string, unknown>;
  /** Index of its motion in `generated.samples`. */
  sample?: number;
}
export interface SceneJson {
  format?: string;
  version?: number;
  id?: string;
  name?: string;
  meta?: { source?: string; source_id?: string; licence?: string; parent_id?: string | null; [k: string]: unknown };
  time?: { step_s?: number; steps?: number; now_step?: number };
  map: MapJson | MapRef;
  signals?: SignalJson[];
  agents: AgentJson[];
  generated?: GeneratedJson | null;
  x_editor?: EditorJson;
  /** The layout of the map. */
  x_layout?: unknown;
}

export const isMapRef = (m: MapJson | MapRef): m is MapRef => typeof (m as MapRef).ref === 'string';
