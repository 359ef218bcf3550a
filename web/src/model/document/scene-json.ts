// The scene document as it travels and is stored (`dragtraffic.scene`, version 1), and what answers say of futures.
// Of a document members that may be missing are optional: the reader is tolerant, the writer is not.
import type { Feedback } from './feedback';
import type { components } from '../base/api';

type Schemas = components['schemas'];

export type Point = [number, number] | [number, number, number];

export interface LaneJson {
  id: string;
  type?: string;
  points_m: Point[];
  width_m?: number | null;
  speed_limit_mps?: number | null;
  predecessors?: string[];
  successors?: string[];
  interpolating?: boolean;
}
export interface LineJson {
  id?: string;
  type?: string;
  points_m: Point[];
}
export interface AreaJson {
  id?: string;
  polygon_m: Point[];
  holes_m?: Point[][];
}
export interface MapJson {
  lanes?: LaneJson[];
  road_lines?: LineJson[];
  road_edges?: LineJson[];
  crosswalks?: AreaJson[];
  speed_bumps?: AreaJson[];
  driveways?: AreaJson[];
  stop_signs?: { id?: string; position_m: Point; lanes?: string[] }[];
  drivable?: AreaJson[];
}
export interface MapRef {
  ref: string;
}
export interface SignalJson {
  lane: string;
  stop_m?: Point | null;
  states: [number, string][];
}
export interface TrackJson {
  first_step?: number;
  valid?: [number, number][];
  x_m: number[];
  y_m: number[];
  heading_rad: number[];
  vx_mps?: number[] | null;
  vy_mps?: number[] | null;
}
export interface StartJson {
  x_m?: number | null;
  y_m?: number | null;
  heading_rad?: number | null;
  speed_mps?: number | null;
}
/** `may_cross`: ids of road edges that this one may go over on its way. */
export interface GoalJson extends StartJson {
  time_s?: number | null;
  may_cross?: string[];
}
/** A place on the way. */
export type ViaJson = Schemas['ViaDoc'];
export interface ConditionJson {
  type?: 'vehicle' | 'pedestrian' | 'cyclist' | null;
  length_m?: number;
  width_m?: number;
  start?: StartJson;
  goal?: GoalJson;
  via?: ViaJson[];
}
export interface AgentJson {
  id: string;
  type: string;
  subtype?: string;
  role?: string | null;
  length_m: number;
  width_m: number;
  height_m?: number | null;
  track: TrackJson;
  conditions?: ConditionJson | null;
}
export type FaultKind = Schemas['FaultKind'];
/** `edge`: id of the road edge that it goes over. */
export type FaultJson = Schemas['Fault'] & { edge?: string | null };
export type RelationKind = Schemas['RelationKind'];
export type RelationJson = Schemas['Relation'];
export type Manoeuvre = Schemas['Manoeuvre'];
/** `anchor`: which of the generator's ideas the future follows; absent for staying at rest. */
export interface ModeJson extends TrackJson {
  probability: number;
  name?: string;
  anchor?: number | null;
  faults?: FaultJson[];
  relations?: RelationJson[];
  manoeuvre?: Manoeuvre | null;
}
/** A future as it was shown last: box centres every 0.5 s, the first 0.5 s after the start. */
export type ShownJson = Schemas['ShownDoc'];
export type ReactionKind = Schemas['ReactionKind'];
/** Why a road user gave up the motion it had: whom it answers, and where it waits or is slowest. */
export type ReactionJson = Schemas['Reaction'];
/** `reaction`: absent for whoever was asked for or does as before. */
export interface AgentFuturesJson {
  chosen: number;
  modes: ModeJson[];
  reaction?: ReactionJson | null;
}
export interface SampleJson {
  agents: Record<string, AgentFuturesJson>;
  score?: unknown;
}
export interface GeneratedJson {
  chosen_sample?: number;
  samples: SampleJson[];
  stale?: boolean;
  seed?: number;
  [k: string]: unknown;
}
export type FeaturesJson = Schemas['Features'];
export type TraitJson = Schemas['Trait'];
export type WishJson = Schemas['Wish'];
export type LearnedWishJson = Schemas['LearnedWish'];
/** A future among those that are shown to be judged. */
export type RoundCardJson = Schemas['RoundCard'];
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
