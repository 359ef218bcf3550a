// Runs that an address names. What shows them loads with the first one.
import { signal, type ReadonlySignal } from '@preact/signals-core';
import type { Client } from '../../../net/client';
import type { Library } from '../../document/library';
import type { SceneCare } from '../../document/scene-care';
import type { Editor } from '../../session/editor';
import type { FollowedRun } from './followed-run';

/** The fragment of an address that names a run starts with this. */
const MARK = '#run=';

export class Following {
  readonly #run = signal<FollowedRun | null>(null);
  /** What shows runs; null before the first. */
  readonly run: ReadonlySignal<FollowedRun | null> = this.#run;

  constructor(
    private readonly editor: Editor,
    private readonly library: Library,
    private readonly care: SceneCare,
    private readonly client: Client,
  ) {}

  /** Shows the run that a fragment names, and goes with it. False where it names none, or one that is not there. */
  async openFrom(hash: string): Promise<boolean> {
    if (!hash.startsWith(MARK)) return false;
    const { FollowedRun } = await import('./followed-run');
    this.#run.value ??= new FollowedRun(this.editor, this.library, this.care, this.client);
    return this.#run.value.open(hash.slice(MARK.length));
  }
}
