// A handle drag: previews the resulting document; the release is one step.
import type { LaneName } from '../../model/words/arm-names';
import { batch, computed, signal, type ReadonlySignal } from '@preact/signals-core';
import type { Command } from '../../model/document/commands';
import type { Agent } from '../../model/document/scene';
import type { OnLine, Vec } from '../../model/base/geometry';
import type { Document } from '../document/document';
import { TEXTS } from '../../texts/editing/generation';
import type { Answers } from './answers';
import type { Commits } from './commits';
import type { Notices } from './notices';
import type { Playhead } from './playhead';

export type HandlePart = 'start' | 'goal';
export type HandleName = 'body' | 'heading' | 'speed' | 'time' | 'via' | 'ring';
export interface Grip {
  readonly part: HandlePart;
  readonly handle: HandleName;
  /** Index of the via point. */
  readonly index?: number;
  /** Taken by its tag at the edge of the picture: the flag itself is outside. */
  readonly edge?: true;
}

/** Lag of the flag behind the pointer while a kerb holds it back: from the flag to the pointer, metres. */
export interface Lag {
  readonly from: Vec;
  readonly to: Vec;
  readonly touch: boolean;
}

/** The lane under the dragged handle, by name and id, the stop line it snaps to, and the lag at a kerb. */
export interface DragPlace {
  readonly lane: LaneName | null;
  readonly laneId: string | null;
  readonly stop: OnLine | null;
  readonly lag: Lag | null;
}
export interface DragInfo extends DragPlace {
  readonly grip: Grip;
}

/** The parts of the session that a drag uses. */
export interface Dragged {
  readonly document: Document;
  readonly answers: Answers;
  readonly playhead: Playhead;
  readonly notices: Notices;
  readonly commits: Commits;
  /** Keys move this handle too, from now on. */
  takeGrip(grip: Grip): void;
}

export class Drag {
  readonly #info = signal<DragInfo | null>(null);
  /** Goal headings that came from a lane and may follow the next one, as `part:id`. */
  readonly #snappedHeadings = new Set<string>();

  /** Null while nothing is dragged. */
  readonly info: ReadonlySignal<DragInfo | null> = computed(() =>
    this.of.document.trial.value ? this.#info.value : null,
  );
  /** Changes only when a drag begins or ends. */
  readonly active = computed(() => this.info.value !== null);

  constructor(private readonly of: Dragged) {}

  opened(): void {
    this.#snappedHeadings.clear();
  }

  begin(grip: Grip): void {
    const { answers, commits, document, notices, playhead } = this.of;
    if (commits.refused()) return;
    batch(() => {
      playhead.pause();
      this.of.takeGrip(grip);
      document.begin();
      this.#info.value = { grip, lane: null, laneId: null, stop: null, lag: null };
      answers.dragBegan();
      notices.hide();
    });
  }

  /** A frame of the drag: previews the document. No effect once the drag has ended. */
  preview(command: Command): void {
    batch(() => {
      if (this.of.document.preview(command)) this.of.answers.dragMoved();
    });
  }

  over(place: DragPlace): void {
    const old = this.info.peek();
    if (!old) return;
    const { laneId, lane, stop, lag } = place;
    const moved = old.laneId !== laneId || old.lane?.name !== lane?.name;
    if (moved || (old.stop === null) !== (stop === null) || old.lag !== lag)
      this.#info.value = { grip: old.grip, ...place };
  }

  /** The release: one undo step, or none where nothing was moved. */
  end(command: Command | null): void {
    this.of.commits.release(command);
  }

  /** Restores everything to before the drag. */
  cancel(): void {
    const { answers, document, notices } = this.of;
    if (!document.trial.peek()) return;
    batch(() => {
      document.cancel();
      answers.dragPutBack();
    });
    notices.say(TEXTS.restored);
    document.settle();
  }

  /** May a lane set this heading? It may if a lane set it before. */
  headingFollows(part: HandlePart, a: Agent): boolean {
    return this.#snappedHeadings.has(`${part}:${a.id}`);
  }

  setHeadingFollows(part: HandlePart, a: Agent, follows: boolean): void {
    if (follows) this.#snappedHeadings.add(`${part}:${a.id}`);
    else this.#snappedHeadings.delete(`${part}:${a.id}`);
  }
}
