// A tab without a page: session, document, saving and library, with a server and a storage of the test.
import { SpeedCurve } from '../../src/edit/tools/speed-curve/speed-curve';
import { Editor } from '../../src/edit/session/editor';
import { Generation } from '../../src/edit/asking/generation';
import { Journal } from '../../src/edit/document/journal';
import { Library } from '../../src/edit/document/library';
import { Saving } from '../../src/edit/document/saving';
import { SceneCare } from '../../src/edit/document/scene-care';
import { SceneFile } from '../../src/edit/document/scene-file';
import { SceneList } from '../../src/edit/document/scene-list';
import { Client } from '../../src/net/client';
import { SceneTurns } from '../../src/net/scene-lock';
import { PassingStepStore, type StepStore } from '../../src/net/step-store';
import { InMemoryGenerator } from '../edit/session';
import type { ScriptedServer } from './server';

/** Shared state of a browser's tabs, as one of them sees it. */
export interface Surroundings {
  readonly store?: StepStore;
  /** Absent for a single tab. */
  readonly browser?: { readonly locks: LockManager; readonly channel: BroadcastChannel };
  /** Is the tab still open? */
  readonly here?: () => boolean;
}

export class Tab {
  readonly editor = new Editor();
  readonly curve = new SpeedCurve(this.editor);
  readonly generator = new InMemoryGenerator();
  readonly client: Client;
  readonly list: SceneList;
  readonly file = new SceneFile(this.editor);
  readonly journal: Journal;
  readonly saving: Saving;
  readonly library: Library;
  readonly care: SceneCare;
  readonly generation: Generation;

  /** The generator of the others' reactions. */
  readonly others = new InMemoryGenerator();

  constructor(
    server: ScriptedServer,
    { store = new PassingStepStore(), browser, here = () => true }: Surroundings = {},
  ) {
    const { editor, file } = this;
    this.client = new Client('', server.fetcher(here));
    this.list = new SceneList(this.client);
    this.journal = new Journal(store);
    this.saving = new Saving(editor.document, file, this.list, this.client, this.journal);
    this.library = new Library(editor, file, this.saving, this.list, this.client, this.journal, (on) =>
      browser ? new SceneTurns(on, browser.locks, browser.channel) : new SceneTurns(on, null, null),
    );
    this.care = new SceneCare(editor, file, this.library, this.list, this.client, this.journal, this.saving);
    this.generation = new Generation(editor, file, this.saving, this.generator, this.others, (id, joins) =>
      this.curve.takeUp(id, joins),
    );
  }
}
