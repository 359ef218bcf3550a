// Driving the selected road user by the keyboard, while the others react. It loads on demand: few users need it.
import { computed, signal, type ReadonlySignal } from '@preact/signals-core';
import type { Pose } from '../../../model/base/geometry';
import { canMove } from '../../../model/document/scene';
import type { Client } from '../../../net/client';
import type { SceneFile } from '../../document/scene-file';
import type { Editor } from '../../session/editor';
import type { LiveMotion } from '../../session/live';
import type { SessionPart } from '../../session/part';
import type { LiveDrive } from './live-drive';
import { TEXTS } from '../../../texts/editing/driving';

export class Driving implements SessionPart, LiveMotion {
  readonly #drive = signal<LiveDrive | null>(null);
  readonly #coming = signal(false);

  /** The drive, from its start until it is kept or cancelled. */
  readonly open: ReadonlySignal<LiveDrive | null> = this.#drive;
  readonly isOn = computed(() => this.#drive.value !== null);
  readonly frames = computed(() => this.#drive.value?.frames.value ?? 0);
  /** Does the server still prepare it? */
  readonly asking: ReadonlySignal<boolean> = this.#coming;

  constructor(
    private readonly editor: Editor,
    private readonly file: SceneFile,
    private readonly client: Client,
  ) {}

  poseOf(id: string): Pose | null {
    return this.#drive.peek()?.poseOf(id) ?? null;
  }

  /** Prepares a drive of the selected road user; its time runs from the first key on. */
  async begin(): Promise<void> {
    const { editor, file } = this;
    const a = editor.agent.peek();
    const snapshot = file.snapshot();
    if (!a || !canMove(a) || !snapshot || this.#coming.peek() || editor.commits.refused()) return;
    this.#coming.value = true;
    try {
      const { LiveDrive } = await import('./live-drive');
      const drive = await LiveDrive.of(editor, a, snapshot, this.client, () => (this.#drive.value = null));
      // Meanwhile the scene or the selection may have changed.
      const { scene } = snapshot.committed;
      if (editor.resting.peek() === scene && editor.selection.peek() === a.id) this.#drive.value = drive.begun();
      else drive.cancel();
    } catch (e) {
      editor.notices.show({ text: TEXTS.didNotStart(e instanceof Error ? e.message : String(e)) });
    } finally {
      this.#coming.value = false;
    }
  }

  /** Advances it to the time of a frame, milliseconds. */
  frame(now: number): void {
    this.#drive.peek()?.frame(now);
  }

  opened(): void {
    this.#drive.peek()?.cancel();
  }

  followed(): void {
    this.#drive.peek()?.cancel();
  }

  selected(): void {
    this.#drive.peek()?.cancel();
  }
}
