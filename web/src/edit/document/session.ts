// What documents need of the editing session that they are opened in; the editor is one.
import type { ReadonlySignal } from '@preact/signals-core';
import type { Command } from '../../model/document/commands';
import type { MotionSet } from '../../model/document/futures';
import type { KeptHistory } from '../../model/document/history';
import type { Scene } from '../../model/document/scene';
import type { Toast } from '../notices';
import type { Document, Lock } from './document';

export interface Session {
  readonly document: Document;
  readonly notices: { show(toast: Toast, ms?: number): void };
  readonly answers: { outdate(): void };
  /** What all road users do in the committed document, or in the one before it while it is stale. */
  readonly motion: ReadonlySignal<MotionSet>;
  /** Id of the selected road user. */
  readonly selection: ReadonlySignal<string | null>;
  /** Of the playhead, seconds. */
  readonly time: ReadonlySignal<number>;
  open(scene: Scene, saved: MotionSet | null, kept: KeptHistory | null): void;
  lockWith(lock: Lock | null): void;
  run(command: Command): void;
  goTo(step: number | null): void;
  adopt(name: string, scene: Scene): void;
  select(id: string | null): void;
  setTime(t: number): void;
}
