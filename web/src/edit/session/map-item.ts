// A part of the map that a click picks.
import type { Vec } from '../../model/base/geometry';

export type MapItem =
  /** A signal or its stop line, by the lane that obeys it. */
  | { readonly kind: 'signal'; readonly lane: string; readonly at: Vec }
  | { readonly kind: 'stop-sign'; readonly at: Vec }
  | { readonly kind: 'crosswalk'; readonly index: number }
  | { readonly kind: 'lane'; readonly lane: string; readonly at: Vec };
