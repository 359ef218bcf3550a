// A feature of the page: a folder here, and a line in the list of `tools.ts`.
import type { Client } from '../../net/client';
import type { Generator } from '../../net/generator';
import type { RequestBuilder } from '../asking/request-builder';
import type { SceneCare } from '../document/scene-care';
import type { SceneFile } from '../document/scene-file';
import type { RailEntry } from '../gestures/chart';
import type { PointerTools } from '../gestures/pointer';
import type { Placement } from '../moves/placement';
import type { ToolOverlay } from '../overlay/tool-overlay';
import type { Editor } from '../session/editor';

/** Shared parts that features are made from. */
export interface Supplies {
  readonly editor: Editor;
  readonly file: SceneFile;
  readonly care: SceneCare;
  readonly client: Client;
  /** The road users about to be placed, dragged copies included. */
  readonly placement: Placement;
  /** A generator with its own queue of requests. */
  generator(): Generator;
  /** Builds its requests. */
  questions(): RequestBuilder;
}

/** The parts of a feature. Those that follow the session have joined it themselves. */
export interface FeatureParts extends PointerTools {
  /** Its parts, by the names that actions and panels use. */
  readonly named: object;
  readonly overlay?: ToolOverlay;
}

export interface Feature {
  readonly rail?: readonly RailEntry[];
  make(of: Supplies): FeatureParts;
}
