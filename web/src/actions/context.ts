// The parts that an action or a panel uses.
import type { Editor } from '../edit/session/editor';
import type { Library } from '../edit/document/library';
import type { Importing } from '../edit/tools/importing/importing';
import type { Saving } from '../edit/document/saving';
import type { Ownership } from '../edit/document/ownership';
import type { SceneCare } from '../edit/document/scene-care';
import type { Journal } from '../edit/document/journal';
import type { SceneFile } from '../edit/document/scene-file';
import type { SceneList } from '../edit/document/scene-list';
import type { Generation } from '../edit/asking/generation';
import type { Gestures } from '../edit/gestures/pointer';
import type { Picture } from '../edit/overlay/picture';
import type { Playback } from '../edit/session/playback';
import type { Following } from '../edit/tools/following/following';
import type { Tools } from '../edit/tools/tools';
import type { Sharing } from '../edit/document/sharing';
import type { Stage } from '../draw/stage';
import type { Client } from '../net/client';
import type { Form } from './form';
import type { Ui } from './ui';

/** The parts needed to open and show a scene; they load first, all others later. */
export interface Opening {
  readonly editor: Editor;
  readonly scenes: SceneList;
  readonly library: Library;
  readonly journal: Journal;
  readonly file: SceneFile;
  readonly saving: Saving;
  readonly picture: Picture;
  readonly stage: Stage;
  readonly client: Client;
  readonly ui: Ui;
  readonly form: Form;
  /** The place of the top bar. */
  readonly bar: HTMLElement;
}

export interface Context extends Opening, Tools {
  readonly generation: Generation;
  readonly care: SceneCare;
  readonly ownership: Ownership;
  readonly following: Following;
  readonly sharing: Sharing;
  readonly importing: Importing;
  readonly playback: Playback;
  readonly gestures: Gestures;
  /** The browser's clipboard: copies are text, so that another tab can paste them. */
  readonly clipboard: { copy(): void; cut(): void; paste(): void };
  chooseFiles(): void;
  /** Offers to import a part of a map file. */
  choosePart(): void;
  /** Brings road users into view, if they are not. */
  reveal(ids: readonly string[]): void;
  /** Puts the cursor into the name or the note of the selected road user. */
  focusText(which: 'name' | 'note'): void;
  /** Opens the context menu of the selection, beside it. */
  openMenu(): void;
  /** Opens what the fragment of an address names: a scene, or a run. False where it is none of these. */
  openFrom(hash: string): Promise<boolean>;
  focusField(part: 'start' | 'goal', field: string): void;
  focusGroup(step: 1 | -1): void;
  focusAgent(id: string): void;
  /** Moves the focus to the name of the open scene. */
  focusName(): void;
  fit(): void;
  lookAtScene(): void;
}
