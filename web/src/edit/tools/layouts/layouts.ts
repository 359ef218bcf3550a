// A map being made: the template with its parameters, the drawn result, and the selected arm.
import { armTitles } from '../../../model/words/arm-titles';
import { batch, computed, signal, type ReadonlySignal } from '@preact/signals-core';
import type { DrivingSide } from '../../../model/physics/driving-side';
import type { Vec } from '../../../model/base/geometry';
import type { SceneJson } from '../../../model/document/scene-json';
import {
  fitting,
  laneOf,
  NO_CONNECTIONS,
  sameWay,
  type LaneConnection,
  type Connections,
  type LaneOfArm,
} from '../../../model/document/layouts';
import { readScene } from '../../../model/document/scene-reader';
import type { Scene } from '../../../model/document/scene';
import type { Arm, Layout, MapReply, Parameters, TemplateName } from '../../../net/types';
import { TEXTS } from '../../../texts/editing/picture';

/** An arm of the drawn map, with its title in the language of the page. */
export type DrawnArm = MapReply['arms'][number] & { readonly title: string };

/** The drawn map of the server. */
export interface DrawnMap {
  readonly layout: Layout;
  readonly json: SceneJson;
  readonly scene: Scene;
  readonly checks: MapReply['checks'];
  readonly arms: readonly DrawnArm[];
  readonly corners: MapReply['corners'];
  readonly ways: MapReply['ways'];
  /** Duration of the request, milliseconds. */
  readonly ms: number;
}

/** A request for a map. */
export interface MapWish {
  readonly template: TemplateName;
  /** Null for the template's own. */
  readonly parameters: Parameters | null;
  /** The side of a template's own parameters; absent for the usual one. */
  readonly traffic?: DrivingSide;
}

/** The former place of an arm being turned. */
export interface TurnedArm {
  readonly index: number;
  readonly before: Arm;
}

/** Handles of the map. */
export type Knob =
  | { readonly kind: 'arm'; readonly arm: number; readonly at: Vec }
  | { readonly kind: 'lane'; readonly arm: number; readonly side: 'in' | 'out'; readonly by: 1 | -1; readonly at: Vec }
  | { readonly kind: 'kerb'; readonly corner: number; readonly at: Vec }
  | { readonly kind: 'stop'; readonly arm: number; readonly lane: number; readonly at: Vec }
  | { readonly kind: 'way'; readonly arm: number; readonly way: LaneConnection };

/** A knob with a place of its own. */
export type PlacedKnob = Exclude<Knob, { kind: 'way' }>;

/** A way being drawn from a stop line: to an exit, or to the pointer. */
export interface DrawnWay {
  readonly from: LaneOfArm;
  readonly to: LaneOfArm | null;
  readonly at: Vec;
}

export const FEWEST_ARMS = 3;
export const MOST_ARMS = 6;
/** Number of undo steps. */
const MOST_STEPS = 100;
/** Changes of one number within this time are one step, milliseconds. */
const SAME_STEP_MS = 700;

const NO_STEPS = { past: [], next: [] };

export class Layouts {
  readonly #wish = signal<MapWish | null>(null);
  readonly #made = signal<DrawnMap | null>(null);
  readonly #fault = signal<string | null>(null);
  readonly #arm = signal(0);
  readonly #turned = signal<TurnedArm | null>(null);
  readonly #asking = signal(false);
  readonly #way = signal<LaneConnection | null>(null);
  readonly #drawn = signal<DrawnWay | null>(null);
  readonly #under = signal<Knob | null>(null);
  readonly #steps = signal<{ readonly past: readonly MapWish[]; readonly next: readonly MapWish[] }>(NO_STEPS);
  /** The request before a drag, which is one step. */
  #held: MapWish | null = null;
  #last = { number: '', at: 0 };
  /** The request of the shown map, and the steps that led there. */
  #drawnFrom: { readonly wish: MapWish; readonly past: readonly MapWish[] } | null = null;
  /** The scene whose map is edited; null for a new one. */
  #base: SceneJson | null = null;

  /** Null while no map is being made. */
  readonly wish: ReadonlySignal<MapWish | null> = this.#wish;
  readonly isOpen = computed(() => this.wish.value !== null);
  /** Is it a new map, without road users? */
  readonly isNew = computed(() => this.wish.value !== null && !this.#base);
  readonly made = computed<DrawnMap | null>(() => (this.wish.value ? this.#made.value : null));
  /** Why the last change was refused. */
  readonly fault: ReadonlySignal<string | null> = this.#fault;
  /** Index of the selected arm. */
  readonly arm: ReadonlySignal<number> = this.#arm;
  readonly turned: ReadonlySignal<TurnedArm | null> = this.#turned;
  readonly asking: ReadonlySignal<boolean> = this.#asking;
  /** The requested parameters, or the template's. */
  readonly parameters = computed<Parameters | null>(
    () => this.#wish.value?.parameters ?? (this.#made.value?.layout.parameters as Parameters | undefined) ?? null,
  );
  readonly arms = computed<readonly Arm[]>(() => this.parameters.value?.arms ?? []);

  /** The selected way, of the selected arm. */
  readonly way = computed<LaneConnection | null>(() => {
    const way = this.#way.value;
    return way && this.ways.value.some((w) => sameWay(w, way)) ? way : null;
  });
  readonly ways = computed<MapReply['ways']>(() => this.made.value?.ways ?? []);
  readonly drawn: ReadonlySignal<DrawnWay | null> = this.#drawn;
  /** The handle under the pointer. */
  readonly under: ReadonlySignal<Knob | null> = this.#under;
  readonly canUndo = computed(() => this.#steps.value.past.length > 0);
  readonly canRedo = computed(() => this.#steps.value.next.length > 0);

  get base(): SceneJson | null {
    return this.#base;
  }

  /** Begins with a template; the last map stays on the picture until the new one arrives. */
  choose(template: TemplateName, traffic?: DrivingSide): void {
    batch(() => {
      this.#forget();
      this.#clear();
      this.#step({ template, parameters: null, ...(traffic && { traffic }) });
    });
  }

  /** Begins with the layout of a scene's map. */
  change({ template, parameters }: Layout, base: SceneJson): void {
    this.#base = base;
    batch(() => {
      this.#forget();
      this.#wish.value = { template, parameters: parameters as Parameters };
    });
  }

  /** The returned function reopens it unchanged; null where nothing was edited. */
  close(): (() => void) | null {
    const left = { wish: this.#now(), made: this.#made.peek(), arm: this.#arm.peek(), steps: this.#steps.peek() };
    const base = this.#base;
    const reopen = (): void => {
      this.#base = base;
      batch(() => {
        this.#wish.value = left.wish;
        this.#made.value = left.made;
        this.#arm.value = left.arm;
        this.#steps.value = left.steps;
      });
    };
    this.#base = null;
    this.#held = null;
    batch(() => {
      this.#forget();
      this.#wish.value = null;
      this.#clear();
      this.#turned.value = null;
      this.#asking.value = false;
      this.#steps.value = NO_STEPS;
    });
    return left.steps.past.length ? reopen : null;
  }

  /** Removes the drawn map. */
  #clear(): void {
    this.#made.value = null;
    this.#drawnFrom = null;
  }

  #forget(): void {
    this.#arm.value = 0;
    this.#fault.value = null;
    this.#way.value = null;
    this.#drawn.value = null;
    this.#under.value = null;
  }

  set(change: Partial<Parameters>): void {
    const wish = this.#wish.peek();
    const parameters = this.parameters.peek();
    if (!wish || !parameters) return;
    const numbers = Object.entries(change).filter(([, v]) => typeof v === 'number');
    this.#step({ ...wish, parameters: { ...parameters, ...change } }, numbers.map(([name]) => name).join());
  }

  // -------------------------------------------------------------- steps

  /** `number` names a value that may change many times in one step. */
  #step(wish: MapWish, number = ''): void {
    const before = this.#now();
    this.#wish.value = wish;
    if (!before || this.#held) return;
    const now = performance.now();
    const again = number && number === this.#last.number && now - this.#last.at < SAME_STEP_MS;
    this.#last = { number, at: now };
    if (!again) this.#steps.value = { past: [...this.#steps.peek().past, before].slice(-MOST_STEPS), next: [] };
  }

  /** All changes from here to `letGo` are one step. */
  hold(): void {
    this.#held = this.#now();
  }

  /** The request, with the parameters that the template has by default. */
  #now(): MapWish | null {
    const wish = this.#wish.peek();
    return wish && { ...wish, parameters: this.parameters.peek() };
  }

  letGo(): void {
    const before = this.#held;
    this.#held = null;
    this.#last = { number: '', at: 0 };
    if (this.#fault.peek()) this.#backToMade();
    else if (before && before.parameters !== this.parameters.peek())
      this.#steps.value = { past: [...this.#steps.peek().past, before].slice(-MOST_STEPS), next: [] };
  }

  /** Restores the state before the drag. */
  putBack(): void {
    if (this.#held) this.#wish.value = this.#held;
  }

  undo(): void {
    const { past, next } = this.#steps.peek();
    this.#goTo(past.at(-1), { past: past.slice(0, -1), next: [this.#now()!, ...next] });
  }

  redo(): void {
    const { past, next } = this.#steps.peek();
    this.#goTo(next[0], { past: [...past, this.#now()!], next: next.slice(1) });
  }

  #goTo(wish: MapWish | undefined, steps: { past: readonly MapWish[]; next: readonly MapWish[] }): void {
    if (!wish) return;
    batch(() => {
      if (wish.template !== this.#wish.peek()?.template) this.#clear();
      this.#fault.value = null;
      this.#wish.value = wish;
      this.#steps.value = steps;
      this.#last = { number: '', at: 0 };
      this.#arm.value = Math.min(this.#arm.peek(), Math.max(0, (wish.parameters?.arms?.length ?? FEWEST_ARMS) - 1));
    });
  }

  // -------------------------------------------------------------- arms

  take(arm: number): void {
    if (arm !== this.#arm.peek()) this.#way.value = null;
    this.#arm.value = arm;
  }

  step(by: 1 | -1): void {
    const count = this.arms.peek().length;
    if (count) this.take((this.#arm.peek() + by + count) % count);
  }

  setArm(index: number, change: Partial<Arm>): void {
    const arms = this.arms.peek();
    // Other lanes need other turns.
    const turns = change.lanes_in !== undefined && change.turns === undefined ? { turns: null } : {};
    const changed = arms.map((a, i) => (i === index ? { ...a, ...change, ...turns } : a));
    this.set({ arms: changed, ...this.#kept(fitting(this.connections, changed)) });
  }

  /** Adds an arm like the selected one. */
  addArm(angle_deg: number): void {
    const arms = this.arms.peek();
    const like = arms[this.#arm.peek()];
    if (!like || arms.length >= MOST_ARMS) return;
    batch(() => {
      this.set({ arms: [...arms, { ...like, angle_deg: Math.round(angle_deg), main: false, turns: null }] });
      this.take(arms.length);
    });
  }

  removeArm(index: number): void {
    const arms = this.arms.peek();
    if (arms.length <= FEWEST_ARMS) return;
    batch(() => {
      const left = arms.filter((_, i) => i !== index);
      this.set({ arms: left, ...this.#kept(fitting(this.connections, left, index)) });
      this.take(0);
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

  // -------------------------------------------------------------- connections

  get connections(): Connections {
    return { ...NO_CONNECTIONS, ...this.parameters.peek()?.connections };
  }

  /** As a change of the parameters: templates without connections get none. */
  #kept(connections: Connections): Partial<Parameters> {
    const { added, removed } = connections;
    const before = this.parameters.peek()?.connections;
    return before || added.length || removed.length
      ? { connections: { added: [...added], removed: [...removed] } }
      : {};
  }

  /** Do lanes connect arms, so that connections can be edited? */
  get connects(): boolean {
    const template = this.#wish.peek()?.template;
    return template === 'three-arms' || template === 'four-arms';
  }

  /** An exit by its arm, and by its lane where there are several. */
  exitName([arm, lane]: LaneOfArm): string {
    const name = this.made.value?.arms[arm]?.title ?? '';
    return (this.arms.value[arm]?.lanes_out ?? 0) > 1 ? TEXTS.exitLane(name, lane + 1) : name;
  }

  pickWay(way: LaneConnection | null): void {
    batch(() => {
      if (way) this.#arm.value = laneOf(way.from)[0];
      this.#way.value = way;
    });
  }

  /** Adds a way from lane to lane; `ways`: the present ones without it. */
  addWay(way: LaneConnection, ways: readonly LaneConnection[] = this.ways.peek()): void {
    const { added, removed } = this.connections;
    const others = removed.filter((c) => !sameWay(c, way));
    if (others.length !== removed.length) this.set(this.#kept({ added, removed: others }));
    else if (![...ways, ...added].some((c) => sameWay(c, way)))
      this.set(this.#kept({ added: [...added, way], removed }));
  }

  removeWay({ from, to }: LaneConnection): void {
    const way = { from, to };
    const { added, removed } = this.connections;
    const kept = added.filter((c) => !sameWay(c, way));
    const alone = this.ways.peek().some((w) => sameWay(w, way) && w.added);
    this.set(this.#kept({ added: kept, removed: alone ? removed : [...removed, way] }));
  }

  /** Restores the ways that the turn lanes give; without a lane, for the whole arm. */
  usualWays(arm: number, lane: number | null = null): Partial<Parameters> {
    const own = (c: LaneConnection): boolean => {
      const [a, l] = laneOf(c.from);
      return a === arm && (lane === null || l === lane);
    };
    const { added, removed } = this.connections;
    return this.#kept({ added: added.filter((c) => !own(c)), removed: removed.filter((c) => !own(c)) });
  }

  /** New turn lanes replace the ways of their lane. */
  setTurns(arm: number, lane: number, turns: Arm['turns']): void {
    const arms = this.arms.peek().map((a, i) => (i === arm ? { ...a, turns } : a));
    this.set({ arms, ...this.usualWays(arm, lane) });
  }

  drawWay(drawn: DrawnWay | null): void {
    this.#drawn.value = drawn;
  }

  point(under: Knob | null): void {
    if (JSON.stringify(under) !== JSON.stringify(this.#under.peek())) this.#under.value = under;
  }

  // -------------------------------------------------------------- answer

  ask(): void {
    this.#asking.value = true;
  }

  /** Is it the request that the shown map was drawn from? */
  isDrawn(wish: MapWish): boolean {
    return wish === this.#drawnFrom?.wish;
  }

  settle(wish: MapWish, reply: MapReply, ms: number): void {
    // Later requests may have added steps to these; the drawn map can still be restored.
    this.#drawnFrom = { wish, past: this.#steps.peek().past };
    const json = reply.scene as unknown as SceneJson;
    const { layout, checks, corners, ways } = reply;
    const arms = titled(reply);
    batch(() => {
      this.#asking.value = false;
      this.#fault.value = null;
      this.#made.value = { layout, json, scene: readScene(json), checks, arms, corners, ways, ms };
    });
  }

  /** A refused request is dropped: fields and handles show the present map. */
  refuse(why: string): void {
    batch(() => {
      this.unanswered(why);
      if (!this.#held) this.#backToMade();
    });
  }

  /** The server drew nothing: the request and the present map stay. */
  unanswered(why: string): void {
    batch(() => {
      this.#asking.value = false;
      this.#fault.value = why;
    });
  }

  #backToMade(): void {
    const was = this.#drawnFrom;
    if (!was || was.wish === this.#wish.peek()) return;
    this.#wish.value = was.wish;
    this.#steps.value = { ...this.#steps.peek(), past: was.past };
  }
}

/** The arms of a reply by the angles of its parameters, which are in the same order. */
function titled({ layout, arms }: MapReply): DrawnArm[] {
  const drawn = 'arms' in layout.parameters ? layout.parameters.arms : [];
  const titles = armTitles(drawn.map((arm) => arm.angle_deg));
  return arms.map((arm, i) => ({ ...arm, title: titles[i] ?? arm.name }));
}
