// The part of the editing session that documents need; the editor implements it.
import type { ReadonlySignal } from '@preact/signals-core';
import type { Command } from '../../model/document/commands';
import type { MotionSet } from '../../model/document/futures';
import type { KeptHistory } from '../../model/document/history';
import type { Scene } from '../../model/document/scene';
import type { Document, Lock } from './document';

export interface Toast {
  readonly text: string;
  readonly undo?: boolean;
  readonly action?: ToastAction;
  /** A second action beside it. */
  readonly second?: ToastAction;
}

export interface ToastAction {
  readonly label: string;
  readonly run: () => void;
}

export interface Session {
  readonly document: Document;
  readonly notices: { show(toast: Toast, ms?: number): void };
  readonly answers: {
    /** Motions of all road users in the committed document, or in the one before it while it is stale. */
    readonly motion: ReadonlySignal<MotionSet>;
    outdate(): void;
  };
  /** Id of the selected road user. */
  readonly selection: ReadonlySignal<string | null>;
  /** `time`: seconds. */
  readonly playhead: { readonly time: ReadonlySignal<number>; moveTo(seconds: number): void };
  readonly commits: {
    run(command: Command): void;
    goTo(step: number | null): void;
    adopt(name: string, scene: Scene): void;
  };
  open(scene: Scene, saved: MotionSet | null, kept: KeptHistory | null): void;
  lockWith(lock: Lock | null): void;
  select(id: string | null): void;
}
