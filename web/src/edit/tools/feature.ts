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

/** What features are made of. */
export interface Supplies {
  readonly editor: Editor;
  readonly file: SceneFile;
  readonly care: SceneCare;
  readonly client: Client;
  /** Who is about to be placed: copies that are dragged are too. */
  readonly placement: Placement;
  /** One that asks for itself alone. */
  generator(): Generator;
  /** How it writes its questions. */
  questions(): RequestBuilder;
}

/** What a feature consists of. What follows the session has joined it by itself. */
export interface Made extends PointerTools {
  /** Its parts, by the names under which actions and panels find them. */
  readonly named: object;
  readonly overlay?: ToolOverlay;
}

export interface Feature {
  readonly rail?: readonly RailEntry[];
  make(of: Supplies): Made;
}
