// Hooks of a part that joins the session. Each is optional; the session knows no part by name.
import type { ReadonlySignal } from '@preact/signals-core';
import type { HistoryStep } from '../../model/document/history';
import type { Scene } from '../../model/document/scene';
import type { HistoryDirection } from '../../model/document/scene-diff';
import type { Commit } from '../document/document';
import type { Step } from '../document/step';

export interface SessionPart {
  /** Another scene has been opened; called within the same batch. */
  opened?(scene: Scene): void;
  /** A change was committed; called within the same batch. `way`: direction in the history; null for a new step. */
  followed?(commit: Commit, step: Step, way: HistoryDirection | 'there' | null): void;
  /** The same after the batch. */
  committed?(scene: Scene, step: Step): void;
  /** Undo or redo passed a step. */
  travelled?(step: HistoryStep, way: HistoryDirection): void;
  /** Another road user is selected; null for none, or several. */
  selected?(id: string | null): void;
  /** Another tool of the rail is active; called within the same batch. */
  toolChosen?(name: string): void;
  /** Does it wait for an answer? */
  readonly asking?: ReadonlySignal<boolean>;
}
