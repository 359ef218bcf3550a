// A run on the server that somebody else steps: its scene read-only, with everybody where they are in the run.
import { batch, computed, signal, type ReadonlySignal } from '@preact/signals-core';
import type { Pose } from '../../../model/base/geometry';
import { Away, Refused, type Client } from '../../../net/client';
import { followRun, runScene, type RunEvent } from '../../../net/run-follower';
import type { StepReply } from '../../../net/run-line';
import type { Library } from '../../document/library';
import type { SceneCare } from '../../document/scene-care';
import type { Editor } from '../../session/editor';
import type { LiveMotion } from '../../session/live';
import type { SessionPart } from '../../session/part';
import { TEXTS } from '../../../texts/editing/following';

export class FollowedRun implements SessionPart, LiveMotion {
  readonly #step = signal<StepReply | null>(null);
  readonly #egos = signal<readonly string[]>([]);
  readonly #ended = signal(false);
  #over = new AbortController();

  readonly isOn = computed(() => this.#step.value !== null);
  readonly frames = computed(() => this.#step.value?.number ?? 0);
  /** Scene time of the last step, seconds. */
  readonly time = computed(() => this.#step.value?.time_s ?? 0);
  /** Who is driven from outside. */
  readonly egos: ReadonlySignal<readonly string[]> = this.#egos;
  /** Does nothing more come? */
  readonly ended: ReadonlySignal<boolean> = this.#ended;

  constructor(
    private readonly editor: Editor,
    private readonly library: Library,
    private readonly care: SceneCare,
    private readonly client: Client,
  ) {
    editor.join(this);
    editor.reading.showLive(eitherLive(editor.reading.live, this));
  }

  poseOf(id: string): Pose | null {
    const s = this.#step.peek()?.states[id];
    return s ? { x: s.x_m, y: s.y_m, heading: s.heading_rad, speed: Math.hypot(s.vx_mps, s.vy_mps) } : null;
  }

  /** Shows a run by its id, and goes with it. False where it is not there. */
  async open(run: string): Promise<boolean> {
    try {
      const scene = await runScene(this.client, run);
      const copy = (): void => void this.#copy(scene.name ?? TEXTS.run);
      await this.library.show(scene, { words: TEXTS.drivenElsewhere, label: TEXTS.makeACopy, run: copy });
      void this.#follow((over) => followRun(this.client, run, over));
      return true;
    } catch (e) {
      if (!(e instanceof Refused)) throw e;
      this.#refuse(TEXTS.notThere(e.message));
      return false;
    }
  }

  /** Says why; where another scene opens first, which hides what was said, after that. */
  #refuse(text: string): void {
    const { isOpen, notices } = this.editor;
    if (isOpen.peek()) return notices.show({ text });
    const stop = this.library.opened.listen(() => {
      stop();
      notices.show({ text });
    });
  }

  /** Another scene is open. */
  opened(): void {
    this.#over.abort();
    this.#step.value = null;
  }

  /** From now on it is an own scene, as it was when the run began. */
  async #copy(name: string): Promise<void> {
    await this.care.saveAs(name);
    if (this.editor.document.lock.peek() !== null) return;
    this.opened();
    history.replaceState(null, '', location.pathname + location.search);
  }

  async #follow(begin: (over: AbortSignal) => AsyncIterable<RunEvent>): Promise<void> {
    const over = new AbortController();
    this.#over = over;
    this.#ended.value = false;
    try {
      for await (const event of begin(over.signal)) {
        if (over.signal.aborted) return;
        this.#hear(event);
      }
    } catch (e) {
      if (over.signal.aborted) return;
      if (!(e instanceof Refused) && !(e instanceof Away) && !(e instanceof TypeError)) throw e;
    }
    if (!over.signal.aborted) this.#ended.value = true;
  }

  #hear(event: RunEvent): void {
    batch(() => {
      if (event.event === 'run') {
        this.#egos.value = event.run.egos;
        this.#step.value = event.run.present;
      } else if (event.event === 'step') this.#step.value = event.step;
      // Clock and signals are those of the run.
      this.editor.playhead.moveTo(this.time.value);
    });
  }
}

/** Two sources of motion as one: they are never on together. */
function eitherLive(a: LiveMotion, b: LiveMotion): LiveMotion {
  const on = (): LiveMotion => (a.isOn.value ? a : b);
  return {
    isOn: computed(() => on().isOn.value),
    frames: computed(() => on().frames.value),
    poseOf: (id) => (a.isOn.peek() ? a : b).poseOf(id),
  };
}
