// One drive: keys move the road user here, frame by frame; ten times a second the server is told where it is, and moves
// all others. Time stands still until the first key, and while the page has not got the keyboard.
import { batch, signal, type ReadonlySignal } from '@preact/signals-core';
import type { Pose, Vec } from '../../../model/base/geometry';
import { STEP_S, type Columns } from '../../../model/base/motion';
import { recordDrive } from '../../../model/document/drive';
import type { Agent } from '../../../model/document/scene';
import { driveOn, type Controls, type DrivenPose } from '../../../model/physics/steering';
import type { Client } from '../../../net/client';
import { Refused } from '../../../net/client';
import { RunLine, type StepReply } from '../../../net/run-line';
import type { Snapshot } from '../../document/scene-file';
import type { Editor } from '../../session/editor';
import { TEXTS } from '../../../texts/editing/driving';

/** Longest time that a frame stands for, seconds. */
const MOST_FRAME_S = 0.05;

/** Effects of held keys, by the places of the keys. */
const PACE: Readonly<Record<string, 1 | -1>> = { KeyW: 1, ArrowUp: 1, KeyS: -1, ArrowDown: -1 };
const TURN: Readonly<Record<string, 1 | -1>> = { KeyA: 1, ArrowLeft: 1, KeyD: -1, ArrowRight: -1 };
const HARD = 'Space';

type StateJson = StepReply['states'][string];

const speedOf = ({ vx_mps, vy_mps }: StateJson): number => Math.hypot(vx_mps, vy_mps);

export class LiveDrive {
  readonly #held = new Set<string>();
  readonly #frames = signal(0);
  readonly #moves = signal(false);
  readonly #event = signal('');
  /** States at the steps so far, the start first. */
  readonly #steps: StepReply[];
  readonly #way: Vec[];
  readonly #length: number;
  #me: DrivenPose;
  #time = 0;
  /** Steps that were sent; one more than answered while an answer is under way. */
  #sent = 0;
  #last = 0;
  #over = false;
  #answered: Promise<void> = Promise.resolve();

  readonly frames: ReadonlySignal<number> = this.#frames;
  /** Does its time run? */
  readonly moves: ReadonlySignal<boolean> = this.#moves;
  /** What happened last, in words; empty before anything did. */
  readonly event: ReadonlySignal<string> = this.#event;

  private constructor(
    private readonly editor: Editor,
    readonly agent: Agent,
    private readonly line: RunLine,
    private readonly ended: () => void,
  ) {
    const { x_m, y_m, heading_rad } = line.present.states[agent.id];
    const speed = speedOf(line.present.states[agent.id]);
    this.#me = { x: x_m, y: y_m, heading: heading_rad, speed, accel: 0, bend: 0 };
    this.#steps = [line.present];
    this.#way = [[x_m, y_m]];
    this.#length = Math.round(editor.resting.peek()!.length / STEP_S);
  }

  /** Begins a run on the server. Fails with the reason where it cannot. `ended`: it is over, kept or not. */
  static async of(editor: Editor, a: Agent, from: Snapshot, client: Client, ended: () => void): Promise<LiveDrive> {
    const { seed } = from.committed.scene;
    const begin = (scene: ReturnType<Snapshot['body']>): Promise<RunLine> =>
      RunLine.begin(client, { scene: { ...scene, generated: null }, ego: a.id, seed });
    const line = await begin(from.body()).catch((e: unknown) => {
      // The server may have lost the map that it is told by name.
      if (e instanceof Refused && e.problem.code === 'unknown-map') return begin(from.complete());
      throw e;
    });
    return new LiveDrive(editor, a, line, ended);
  }

  /** Takes the keyboard. */
  begun(): this {
    if (document.activeElement instanceof HTMLElement) document.activeElement.blur();
    addEventListener('keydown', this.#down, { capture: true });
    addEventListener('keyup', this.#up, { capture: true });
    addEventListener('blur', this.#leave);
    const { notices, playhead } = this.editor;
    playhead.rewind();
    notices.hide();
    notices.say(TEXTS.toStart(this.agent.name));
    return this;
  }

  /** The driven road user. */
  get now(): Pose {
    return this.#me;
  }

  /** Where it has been at the steps so far. */
  get way(): readonly Vec[] {
    return this.#way;
  }

  /** Seconds so far, and at most. */
  get time(): number {
    return this.#time;
  }
  get most(): number {
    return this.#length * STEP_S;
  }

  /** Between steps the others go on at their speeds. */
  poseOf(id: string): Pose | null {
    if (id === this.agent.id) return this.#me;
    const step = this.#steps[this.#steps.length - 1];
    const s = step.states[id];
    if (!s) return null;
    const since = this.#time - step.number * STEP_S;
    return { x: s.x_m + s.vx_mps * since, y: s.y_m + s.vy_mps * since, heading: s.heading_rad, speed: speedOf(s) };
  }

  frame(now: number): void {
    if (!this.#moves.peek() || this.#over) return;
    const passed = this.#last ? Math.min(MOST_FRAME_S, (now - this.#last) / 1000) : 0;
    this.#last = now;
    // A late answer holds the time: the others are shown no further ahead than one step.
    const latest = Math.min(this.#length, this.#steps.length + 1) * STEP_S;
    const until = Math.min(this.#time + passed, latest);
    while (this.#time < until - 1e-9) {
      const step = (this.#sent + 1) * STEP_S;
      const to = Math.min(until, step);
      this.#me = driveOn(this.agent, this.#me, this.#controls(), to - this.#time);
      this.#time = to;
      if (to < step - 1e-9) continue;
      // The one before may still be under way: the line keeps their order.
      this.#sent++;
      this.#way.push([this.#me.x, this.#me.y]);
      this.#answered = this.#tell(this.#sent, this.#me);
    }
    batch(() => {
      this.#frames.value++;
      this.editor.playhead.moveTo(this.#time);
    });
    if (this.#sent === this.#length) void this.keep();
  }

  #controls(): Controls {
    const of = (keys: Readonly<Record<string, 1 | -1>>): -1 | 0 | 1 => {
      const both = [...this.#held].map((code) => keys[code] ?? 0);
      return Math.sign(both.reduce<number>((sum, k) => sum + k, 0)) as -1 | 0 | 1;
    };
    return { pace: of(PACE), turn: of(TURN), hard: this.#held.has(HARD) };
  }

  async #tell(number: number, { x, y, heading, speed }: DrivenPose): Promise<void> {
    const velocity = { vx_mps: speed * Math.cos(heading), vy_mps: speed * Math.sin(heading) };
    const ego = { id: this.agent.id, x_m: x, y_m: y, heading_rad: heading, ...velocity };
    try {
      const reply = await this.line.step(number, ego);
      this.#steps.push(reply);
      this.#hear(reply);
    } catch (e) {
      if (!this.#over) void this.keep(e instanceof Error ? e.message : String(e));
    }
  }

  /** Notes who reacts, and what went wrong. */
  #hear({ changes, faults }: StepReply): void {
    const { id } = this.agent;
    const name = (of: string): string => this.editor.resting.peek()?.agents.get(of)?.name ?? of;
    for (const { agent, reaction } of changes) {
      if (reaction.cause === id) this.#event.value = TEXTS.reacts(name(agent));
    }
    for (const { agent, fault } of faults) {
      if (fault.kind !== 'collision' || (agent !== id && fault.with !== id)) continue;
      this.#event.value = TEXTS.hits(name(agent), name(fault.with ?? ''));
      this.editor.notices.say(this.#event.value, true);
    }
  }

  /** Ends it: everybody's motion so far becomes the recording, as one step. `why`: what ended it early. */
  async keep(why = ''): Promise<void> {
    if (this.#over) return;
    this.#end();
    await this.#answered;
    this.line.end();
    const { editor, agent } = this;
    const scene = editor.resting.peek();
    const steps = this.#steps.length;
    this.ended();
    editor.playhead.moveTo(0);
    if (why) editor.notices.refuse(why);
    if (!scene || steps < 2) return;
    const recorded = recordDrive(scene, agent, this.#tracks(), steps);
    editor.commits.run(recorded);
    editor.notices.show({ text: `${recorded.name}.`, undo: true });
  }

  /** Ends it; the scene is as before. */
  cancel(): void {
    if (this.#over) return;
    this.#end();
    this.line.end();
    this.ended();
    this.editor.playhead.moveTo(0);
    this.editor.notices.say(TEXTS.cancelled);
  }

  #end(): void {
    this.#over = true;
    removeEventListener('keydown', this.#down, { capture: true });
    removeEventListener('keyup', this.#up, { capture: true });
    removeEventListener('blur', this.#leave);
  }

  #tracks(): Map<string, Columns> {
    const all = new Map<string, StateJson[]>();
    const first = new Map<string, number>();
    this.#steps.forEach(({ states }, i) => {
      for (const [id, state] of Object.entries(states)) {
        if (!first.has(id)) first.set(id, i);
        const track = all.get(id) ?? [];
        all.set(id, track);
        track.push(state);
      }
    });
    const column = (of: readonly StateJson[], k: keyof StateJson): number[] => of.map((s) => s[k]);
    return new Map(
      [...all].map(([id, of]) => [
        id,
        {
          first_step: first.get(id)!,
          x_m: column(of, 'x_m'),
          y_m: column(of, 'y_m'),
          heading_rad: column(of, 'heading_rad'),
          vx_mps: column(of, 'vx_mps'),
          vy_mps: column(of, 'vy_mps'),
        },
      ]),
    );
  }

  // -------------------------------------------------------------- keys

  readonly #down = (e: KeyboardEvent): void => {
    if (e.ctrlKey || e.metaKey || e.altKey || e.key === 'Tab') return;
    // A focused button is pressed by its own keys.
    if (e.target instanceof HTMLButtonElement && (e.key === 'Enter' || e.key === ' ')) return;
    // All other keys have no meaning meanwhile, except those of the browser.
    if (/^F\d/.test(e.key)) return;
    e.preventDefault();
    e.stopImmediatePropagation();
    if (e.repeat) return;
    if (e.key === 'Escape') this.cancel();
    else if (e.key === 'Enter') void this.keep();
    else if (e.code in PACE || e.code in TURN || e.code === HARD) {
      this.#held.add(e.code);
      if (this.#moves.peek()) return;
      this.#last = 0;
      batch(() => {
        this.#moves.value = true;
        this.#frames.value++;
      });
    }
  };

  readonly #up = (e: KeyboardEvent): void => {
    if (!this.#held.delete(e.code)) return;
    e.preventDefault();
    e.stopImmediatePropagation();
  };

  readonly #leave = (): void => {
    this.#held.clear();
    this.#moves.value = false;
  };
}
