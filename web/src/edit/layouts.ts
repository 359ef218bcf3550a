// A map that is being made: the template with its parameters, what came of it, and the arm in hand.
import { batch, computed, signal, type ReadonlySignal } from '@preact/signals-core';
import type { SceneJson } from '../model/json';
import { readScene } from '../model/read';
import type { Scene } from '../model/scene';
import type { Arm, Layout, MapReply, Parameters, TemplateName } from '../net/types';

/** What the server drew. */
export interface Made {
  readonly layout: Layout;
  readonly json: SceneJson;
  readonly scene: Scene;
  readonly checks: MapReply['checks'];
  readonly arms: MapReply['arms'];
  readonly corners: MapReply['corners'];
  /** How long it took, milliseconds. */
  readonly ms: number;
}

/** What is asked of the server. */
export interface MapWish {
  readonly template: TemplateName;
  /** Null for the template's own. */
  readonly parameters: Parameters | null;
}

/** An arm while it is turned: how it lay before. */
export interface TurnedArm {
  readonly index: number;
  readonly before: Arm;
}

export const FEWEST_ARMS = 3;
export const MOST_ARMS = 6;

export class Layouts {
  readonly #wish = signal<MapWish | null>(null);
  readonly #made = signal<Made | null>(null);
  readonly #fault = signal<string | null>(null);
  readonly #arm = signal(0);
  readonly #turned = signal<TurnedArm | null>(null);
  readonly #asking = signal(false);
  /** The scene whose map is changed; null for a new one. */
  #base: SceneJson | null = null;

  /** Null while no map is being made. */
  readonly wish: ReadonlySignal<MapWish | null> = this.#wish;
  readonly isOpen = computed(() => this.wish.value !== null);
  readonly made = computed<Made | null>(() => (this.wish.value ? this.#made.value : null));
  /** Why the last change was not taken. */
  readonly fault: ReadonlySignal<string | null> = this.#fault;
  /** Index of the arm in hand. */
  readonly arm: ReadonlySignal<number> = this.#arm;
  readonly turned: ReadonlySignal<TurnedArm | null> = this.#turned;
  readonly asking: ReadonlySignal<boolean> = this.#asking;
  /** Parameters as they are wished for, or as the template has them. */
  readonly parameters = computed<Parameters | null>(
    () => this.#wish.value?.parameters ?? (this.#made.value?.layout.parameters as Parameters | undefined) ?? null,
  );
  readonly arms = computed<readonly Arm[]>(() => this.parameters.value?.arms ?? []);

  get base(): SceneJson | null {
    return this.#base;
  }

  /** Begins with a template; the last map stays on the picture until the new one is there. */
  choose(template: TemplateName): void {
    batch(() => {
      this.#arm.value = 0;
      this.#fault.value = null;
      this.#made.value = null;
      this.#wish.value = { template, parameters: null };
    });
  }

  /** Begins with what the map of a scene was made from. */
  change({ template, parameters }: Layout, base: SceneJson): void {
    this.#base = base;
    batch(() => {
      this.#arm.value = 0;
      this.#fault.value = null;
      this.#wish.value = { template, parameters: parameters as Parameters };
    });
  }

  close(): void {
    this.#base = null;
    batch(() => {
      this.#wish.value = null;
      this.#made.value = null;
      this.#fault.value = null;
      this.#turned.value = null;
      this.#asking.value = false;
    });
  }

  set(change: Partial<Parameters>): void {
    const wish = this.#wish.peek();
    const parameters = this.parameters.peek();
    if (wish && parameters) this.#wish.value = { ...wish, parameters: { ...parameters, ...change } };
  }

  // -------------------------------------------------------------- arms

  take(arm: number): void {
    this.#arm.value = arm;
  }

  step(by: 1 | -1): void {
    const count = this.arms.peek().length;
    if (count) this.#arm.value = (this.#arm.peek() + by + count) % count;
  }

  setArm(index: number, change: Partial<Arm>): void {
    const arms = this.arms.peek();
    // Other lanes, other turns.
    const turns = change.lanes_in !== undefined && change.turns === undefined ? { turns: null } : {};
    this.set({ arms: arms.map((a, i) => (i === index ? { ...a, ...change, ...turns } : a)) });
  }

  /** Another arm, like the one in hand. */
  addArm(angle_deg: number): void {
    const arms = this.arms.peek();
    const like = arms[this.#arm.peek()];
    if (!like || arms.length >= MOST_ARMS) return;
    batch(() => {
      this.set({ arms: [...arms, { ...like, angle_deg: Math.round(angle_deg), main: false, turns: null }] });
      this.#arm.value = arms.length;
    });
  }

  removeArm(index: number): void {
    const arms = this.arms.peek();
    if (arms.length <= FEWEST_ARMS) return;
    batch(() => {
      this.set({ arms: arms.filter((_, i) => i !== index) });
      this.#arm.value = 0;
    });
  }

  /** The middle of the widest gap between arms, degrees. */
  widestGap(): number {
    const angles = this.arms
      .peek()
      .map((a) => ((a.angle_deg % 360) + 360) % 360)
      .sort((a, b) => a - b);
    const gap = (i: number) => (((angles[(i + 1) % angles.length] - angles[i]) % 360) + 360) % 360 || 360;
    const widest = angles.map((_, i) => i).reduce((a, b) => (gap(b) > gap(a) ? b : a), 0);
    return Math.round((angles[widest] + gap(widest) / 2) % 360);
  }

  turn(turned: TurnedArm | null): void {
    this.#turned.value = turned;
  }

  // -------------------------------------------------------------- what comes of it

  ask(): void {
    this.#asking.value = true;
  }

  settle(reply: MapReply, ms: number): void {
    const json = reply.scene as unknown as SceneJson;
    const { layout, checks, arms, corners } = reply;
    batch(() => {
      this.#asking.value = false;
      this.#fault.value = null;
      this.#made.value = { layout, json, scene: readScene(json), checks, arms, corners, ms };
    });
  }

  refuse(why: string): void {
    batch(() => {
      this.#asking.value = false;
      this.#fault.value = why;
    });
  }
}
