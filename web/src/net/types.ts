// The API as the editor uses it: names for parts of the generated types. The editor uses no private API, so a script
// can do the same.
import type { Schemas } from '../model/base/schemas';
import type { AgentFuturesJson, AgentJson, SceneJson } from '../model/document/scene-json';

export type SceneListItem = Schemas['SceneItem'];
export type SceneShare = Schemas['SceneShare'];
export type SceneItemChange = { readonly name: string } | { readonly shared: SceneShare };
export type SceneListReply = Schemas['SceneList'];
/** Road users in document form. */
export type PlaceReply = Omit<Schemas['PlaceReply'], 'agents'> & { agents: AgentJson[] };
export type ImportReply = Schemas['ImportReply'];
export type ImportWarning = Schemas['ImportWarning'];
export type FormatInfo = Schemas['FormatInfo'];

/** A refusal. A reply without a problem document has its status as its code, and a title. */
export type Problem = Omit<Partial<Schemas['Problem']>, 'code'> & {
  code: Schemas['Problem']['code'] | `http-${number}`;
  title: string;
};

/** Body of POST /v1/generate, without the scene: that part is large and kept as serialised text. */
export type GenerateOptions = Pick<
  Schemas['GenerateRequest'],
  | 'background'
  | 'draft_delay_ms'
  | 'draft_interval_ms'
  | 'feedback'
  | 'horizon_s'
  | 'kept_futures'
  | 'pinned'
  | 'replan_interval_s'
  | 'shown'
  | 'thresholds'
> &
  Required<
    Pick<
      Schemas['GenerateRequest'],
      'agents' | 'react' | 'conditions' | 'seed' | 'diversity' | 'steps' | 'stream_modes' | 'score'
    >
  >;

/** Events as the editor reads them: futures in columns, whatever the encoding. */
type InColumns<T> = Omit<T, 'agents'> & { agents: Record<string, AgentFuturesJson> };

export type DraftEvent = InColumns<Schemas['DraftEvent']>;
export type FinalEvent = Omit<Schemas['FinalEvent'], 'samples'> & {
  samples: InColumns<Schemas['FinalEvent']['samples'][number]>[];
};
export type GenerateEvent =
  Exclude<Schemas['Event'], Schemas['DraftEvent'] | Schemas['FinalEvent']> | DraftEvent | FinalEvent;

export type Resolved = Schemas['Resolved'];
export type ScoreReply = Schemas['ScoreReply'];

export type { TemplateName } from '../model/document/layouts';
export type MapReply = Schemas['MapReply'];
/** A template with its parameters, completed by the server. */
export type Layout = MapReply['layout'];
export type Arm = Required<Omit<Schemas['Arm'], 'turns'>> & { turns: Schemas['Arm']['turns'] };
/** Parameters of any template: each has some of them. */
export type Parameters = Partial<
  Omit<Schemas['Junction'] & Schemas['Roundabout'] & Schemas['Merge'] & Schemas['Road'] & Schemas['CarPark'], 'arms'>
> & { arms?: readonly Arm[] };

export type { SceneJson };
