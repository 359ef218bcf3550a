// The scene document as it travels and is stored (`dragtraffic.scene`, version 1), and what answers say of futures.
// Of a document members that may be missing are optional: the reader is tolerant, the writer is not.
import type { Feedback } from './feedback';
import type { components } from '../base/api';

type Schemas = components['schemas'];

/** A string where the schema lists words: a reader takes words that it does not know. */
type Open<T> = T extends string ? string : T;
/** A part of a document as a tolerant reader takes it: the members in `Needed` are there, all others may be absent. */
type Read<T, Needed extends keyof T = never, Own = unknown> = {
  [K in Exclude<keyof T, keyof Own>]?: Open<T[K]>;
} & { [K in Exclude<Needed, keyof Own>]: Open<T[K]> } & Own;

export type Point = [number, number] | [number, number, number];
type HasPoints = { points_m: Point[] };
export type LaneJson = Read<Schemas['LaneDoc'], 'id', HasPoints>;
export type LineJson = Read<Schemas['RoadLineDoc'], never, HasPoints>;
export type AreaJson = { id?: string; polygon_m: Point[]; holes_m?: Point[][] };
/** Lists of the schema with the parts that the page reads. */
export interface MapJson {
  lanes?: LaneJson[];
  road_lines?: LineJson[];
  road_edges?: LineJson[];
  crosswalks?: AreaJson[];
  speed_bumps?: AreaJson[];
  driveways?: AreaJson[];
  stop_signs?: Read<Schemas['StopSignDoc'], never, { position_m: Point }>[];
  drivable?: AreaJson[];
}
export type MapRef = Schemas['MapRef'];
export type SignalJson = Read<Schemas['SignalDoc'], 'lane', { stop_m?: Point | null; states: [number, string][] }>;
export type TrackJson = Read<
  Schemas['TrackDoc'],
  'x_m' | 'y_m' | 'heading_rad',
  { valid?: [number, number][]; vx_mps?: number[] | null; vy_mps?: number[] | null }
>;
export type StartJson = Read<Schemas['StartDoc']>;
/** `may_cross`: ids of road edges that this one may go over on its way. */
export type GoalJson = Read<Schemas['GoalDoc']>;
/** A place on the way. */
export type ViaJson = Schemas['ViaDoc'];
export type ConditionJson = Read<
  Omit<Schemas['ConditionsDoc'], 'frame'>,
  never,
  { type?: Schemas['ConditionsDoc']['type']; length_m?: number; width_m?: number; start?: StartJson; goal?: GoalJson }
>;
export type AgentJson = Read<
  Schemas['AgentDoc'],
  'id' | 'type',
  { length_m: number; width_m: number; track: TrackJson; conditions?: ConditionJson | null }
>;
export type FaultKind = Schemas['FaultKind'];
export type FaultJson = Schemas['Fault'];
export type RelationKind = Schemas['RelationKind'];
export type RelationJson = Schemas['Relation'];
export type Manoeuvre = Schemas['Manoeuvre'];
/** `anchor`: which of the generator's ideas the future follows; absent for staying at rest. */
export type ModeJson = TrackJson &
  Pick<Schemas['FutureDoc'], 'probability' | 'anchor' | 'faults' | 'relations' | 'manoeuvre'> & { name?: string };
/** A future as it was shown last: box centres every 0.5 s, the first 0.5 s after the start. */
export type ShownJson = Schemas['ShownDoc'];
export type ReactionKind = Schemas['ReactionKind'];
/** Why a road user gave up the motion it had: whom it answers, and where it waits or is slowest. */
export type ReactionJson = Schemas['Reaction'];
/** `reaction`: absent for whoever was asked for or does as before. */
export type AgentFuturesJson = Omit<Schemas['AgentFuturesDoc'], 'modes'> & { modes: ModeJson[] };
export type SampleJson = Omit<Schemas['SampleDoc'], 'agents'> & { agents: Record<string, AgentFuturesJson> };
export type GeneratedJson = Read<Schemas['GeneratedDoc'], never, { samples: SampleJson[] }>;
export type FeaturesJson = Schemas['Features'];
export type LearnedWishJson = Schemas['LearnedWish'];
export type RoundJson = Schemas['Round'];
export type FeedbackDocJson = Schemas['FeedbackDoc'];
/** What only the editor knows: the generator's own choices stand in `generated`, the user's picks here. */
export interface EditorJson {
  seed?: number;
  diversity?: number;
  others?: string;
  length_s?: number;
  replan_s?: number;
  drawn?: number;
  picked?: Record<string, number>;
  /** Speeds drawn by hand for futures that are picked. */
  curves?: Record<string, unknown>;
  /** The round of cards that the picked future is from. */
  dealt?: Record<string, string>;
  names?: Record<string, string>;
  notes?: Record<string, string>;
  locked?: string[];
  /** What single road users do while others change. */
  does?: Record<string, string>;
  /** Who was put there and not recorded. */
  placed?: string[];
  /** The subtype that was recorded, of those that have been given another. */
  was?: Record<string, string>;
  variants?: VariantJson[];
  /** Futures that stay while others are drawn anew, by road user. */
  pins?: Record<string, PinJson[]>;
  /** What was said of futures in rounds, by road user. */
  feedback?: Record<string, Feedback>;
  /** The same of the whole scene. */
  scene_feedback?: Feedback;
  /** What counts as an event, where that is not as usual. */
  thresholds?: Record<string, number>;
}
/** A pinned future: its motion, and the start and the goal that it was made for. */
export interface PinJson {
  name: string;
  type: string;
  track: TrackJson;
  conditions: ConditionJson;
}
/** A way that the scene could go: what is asked in it, and what is thought of it. */
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
  /** Whose futures it and those made with it were; absent where everybody was worked out anew. */
  subject?: string;
  /** Who was in the scene, and of which kinds. */
  roster: string;
  conditions?: Record<string, ConditionJson>;
  picked?: Record<string, number>;
  dealt?: Record<string, string>;
  does?: Record<string, string>;
  curves?: Record<string, unknown>;
  /** Which of `generated.samples` holds its motion. */
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
  /** What the map was made from. */
  x_layout?: unknown;
}

export const isMapRef = (m: MapJson | MapRef): m is MapRef => typeof (m as MapRef).ref === 'string';
