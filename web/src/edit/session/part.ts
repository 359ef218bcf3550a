// What a part of the page does when the session goes on. Each answers what it cares for; none is known here by name.
import type { ReadonlySignal } from '@preact/signals-core';
import type { HistoryStep } from '../../model/document/history';
import type { Scene } from '../../model/document/scene';
import type { Way } from '../../model/document/scene-diff';
import type { Commit } from '../document/document';
import type { Step } from '../document/step';

export interface Part {
  /** Another scene has been opened; within the same batch. */
  opened?(scene: Scene): void;
  /** A change was committed; within the same batch. `way`: where one travelled in the history; null for a new step. */
  followed?(commit: Commit, step: Step, way: Way | 'there' | null): void;
  /** The same after the batch. */
  committed?(scene: Scene, step: Step): void;
  /** Undo and redo went over a step. */
  travelled?(step: HistoryStep, way: Way): void;
  /** Another road user is selected; null for none, or several. */
  selected?(id: string | null): void;
  /** Another tool of the rail is in hand; within the same batch. */
  toolChosen?(name: string): void;
  /** Does it wait for an answer? */
  readonly asking?: ReadonlySignal<boolean>;
}
