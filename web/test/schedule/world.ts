// The world of a schedule: one server, one browser with tabs that open and close, and a record of all commits.
import { effect } from '@preact/signals-core';
import { versionOf } from '../../src/edit/document/journal';
import type { SceneJson } from '../../src/model/document/scene-json';
import { readScene } from '../../src/model/document/scene-reader';
import type { Scene } from '../../src/model/document/scene';
import {
  PassingStepStore,
  type KeptAnswers,
  type KeptScene,
  type Place,
  type StepStore,
} from '../../src/net/step-store';
import type { HistoryStep } from '../../src/model/document/history';
import { ScriptedServer, type Fate } from '../document/server';
import { Tab } from '../document/tab';
import { crossingJson } from '../helpers';
import { channels, Locks } from '../net/locks';
import type { Dice } from './dice';

/** The page's own scenes are saved; the example stays on this computer. */
export const OWN = ['one', 'two'];
export const EXAMPLE = 'demo-crossing';
export const SCENES = [...OWN, EXAMPLE];

/** Tabs that one run may open, in turn. */
const MOST_TABS = 16;

const whole = crossingJson();
/** Few road users and lanes: a schedule opens and writes scenes thousands of times. */
const small: SceneJson = {
  ...whole,
  signals: [],
  map: { ...whole.map, lanes: (whole.map as { lanes: unknown[] }).lanes.slice(0, 1) } as SceneJson['map'],
  agents: whole.agents.slice(0, 2),
};

/** A step committed in a tab. */
interface Entry {
  readonly scene: string;
  readonly tab: OpenTab;
  readonly step: HistoryStep;
}

export interface OpenTab {
  readonly name: string;
  readonly tab: Tab;
  /** Answered requests to the generator. */
  answered: number;
  here: boolean;
  /** Releases the tab's locks, like a browser when it is closed. */
  release(): void;
}

/** The browser's storage as one tab sees it: it is slow, and writes of a closed tab are lost. */
class TabStore implements StepStore {
  constructor(
    private readonly store: StepStore,
    private readonly here: () => boolean,
    private readonly dice: Dice,
    private readonly off: boolean,
  ) {}

  async #do<T>(work: () => Promise<T>): Promise<T> {
    if (this.off) throw new Error('forbidden');
    await this.#passes();
    if (!this.here()) return new Promise(() => undefined);
    const done = await work();
    await this.#passes();
    return this.here() ? done : new Promise(() => undefined);
  }

  #passes(): Promise<void> | void {
    if (this.dice.chance(0.3)) return new Promise((resolve) => setTimeout(resolve, this.dice.below(40)));
  }

  read = (scene: string): Promise<KeptScene | null> => this.#do(() => this.store.read(scene));
  append = (place: Place, step: HistoryStep | null): Promise<void> => this.#do(() => this.store.append(place, step));
  update = (scene: string, change: (p: Place) => Place): Promise<void> =>
    this.#do(() => this.store.update(scene, change));
  rewrite = (kept: Omit<KeptScene, 'answers'>): Promise<void> => this.#do(() => this.store.rewrite(kept));
  keepAnswers = (scene: string, answers: KeptAnswers | null): Promise<void> =>
    this.#do(() => this.store.keepAnswers(scene, answers));
  forget = (scene: string): Promise<void> => this.#do(() => this.store.forget(scene));
  places = (): Promise<Place[]> => this.#do(() => this.store.places());
}

export class World {
  readonly server = new ScriptedServer();
  readonly store = new PassingStepStore();
  readonly tabs: OpenTab[] = [];
  /** Scenes that another user has changed or deleted. */
  readonly foreign = new Set<string>();
  readonly broken: string[] = [];
  /** Fates of the following requests. */
  weather: (dice: Dice) => Fate = () => ({});
  /** Every committed document, and the newest, of each scene. */
  readonly #documents = new Map<string, Set<string>>(SCENES.map((id) => [id, new Set()]));
  readonly #newest = new Map<string, { readonly scene: Scene; readonly tab: OpenTab | null }>();
  readonly #entries: Entry[] = [];
  readonly #foreignDocuments = new Set<string>();
  readonly #locks = new Locks() as unknown as LockManager;
  readonly #channels = channels(MOST_TABS);
  #seen = 0;
  #opened = 0;

  constructor(
    private readonly dice: Dice,
    readonly storeOff: boolean,
  ) {
    this.server.fate = () => this.weather(this.dice);
    for (const id of SCENES) this.foreignWrite(id, id);
    this.foreign.clear();
  }

  /** Another user, on another computer, writes a scene. */
  foreignWrite(id: string, name: string): void {
    const json = { ...(this.server.scenes.get(id)?.json ?? small), id, name };
    this.server.put(id, json);
    this.foreign.add(id);
    this.#foreignDocuments.add(versionOf(readScene(json)));
    this.#note(readScene(json), null);
  }

  foreignDelete(id: string): void {
    this.server.scenes.delete(id);
    this.foreign.add(id);
  }

  async openTab(): Promise<OpenTab | null> {
    const channel = this.#channels[this.#opened];
    if (!channel) return null;
    const { release, locks } = this.#locksOf();
    const name = `tab ${++this.#opened}`;
    const here = () => open.here;
    const store = new TabStore(this.store, here, this.dice, this.storeOff);
    const post = channel.postMessage.bind(channel);
    const line = Object.assign(channel, { postMessage: (word: unknown) => (here() ? post(word) : undefined) });
    const browser = { locks, channel: line };
    const open: OpenTab = { name, answered: 0, here: true, release } as OpenTab & { tab: Tab };
    Object.assign(open, { tab: new Tab(this.server, { store, browser, here }) });
    this.tabs.push(open);
    this.#watch(open);
    await open.tab.list.refresh().catch(() => undefined);
    return open;
  }

  /** Locks of one tab: released once it is closed. */
  #locksOf(): { locks: LockManager; release: () => void } {
    const held = new Set<() => void>();
    const gone = new AbortController();
    let closed = false;
    const request = (name: string, options: LockOptions, grant: (lock: Lock | null) => Promise<void> | undefined) =>
      closed
        ? new Promise(() => undefined)
        : this.#locks.request(name, options, (lock) => {
            if (closed) return undefined;
            const mine = grant(lock);
            if (!mine) return undefined;
            return Promise.race([mine, new Promise<void>((resolve) => held.add(resolve))]);
          });
    const release = () => {
      closed = true;
      gone.abort();
      for (const free of held) free();
    };
    return { locks: { request } as unknown as LockManager, release };
  }

  /** The tab is closed without a warning: its pending requests never complete. */
  closeTab(open: OpenTab): void {
    open.here = false;
    this.tabs.splice(this.tabs.indexOf(open), 1);
    open.release();
  }

  #watch(open: OpenTab): void {
    const { document, notices } = open.tab.editor;
    let seen = 0;
    effect(() => {
      const committed = document.committed.value;
      if (!committed || committed.version === seen) return;
      seen = committed.version;
      const { scene, step } = committed;
      if (!open.here || document.lock.peek()) return;
      this.#note(scene, open);
      const last = document.history?.step(step);
      if (last) this.#entries.push({ scene: scene.id, tab: open, step: last });
    });
    effect(() => {
      // A tab that hands a scene over leaves saving to the next one.
      const scene = document.lock.value && document.scene.peek();
      if (scene && this.#newest.get(scene.id)?.tab === open) this.#newest.set(scene.id, { scene, tab: null });
    });
    effect(() => {
      if (notices.crash.value) this.broken.push(`${open.name} crashed: ${notices.crash.value}`);
    });
  }

  #isForeign(json: SceneJson): boolean {
    return this.#foreignDocuments.has(versionOf(readScene(json)));
  }

  #note(scene: Scene, tab: OpenTab | null): void {
    this.#documents.get(scene.id)?.add(versionOf(scene));
    this.#newest.set(scene.id, { scene, tab });
  }

  // -------------------------------------------------------------- invariants

  /** At any time: what reached the server was committed before, and no example was saved. */
  checkRequests(): void {
    for (const { method, id, json, status, late } of this.server.seen.slice(this.#seen)) {
      if (method !== 'PUT' || !json) continue;
      // Without storage no other tab can know of it.
      if (this.storeOff && late && status < 300) {
        this.foreign.add(id);
        this.#foreignDocuments.add(versionOf(readScene(json)));
      }
      if (!OWN.includes(id)) this.broken.push(`the example was saved: PUT ${id}`);
      else if (!this.#documents.get(id)!.has(versionOf(readScene(json))))
        this.broken.push(`the server got a document of ${id} that was never committed`);
    }
    this.#seen = this.server.seen.length;
  }

  /** At rest, with a server that answers. */
  async checkAtRest(): Promise<void> {
    this.checkRequests();
    if (this.server.open) this.broken.push(`${this.server.open} requests are still on their way`);
    for (const open of this.tabs) this.#checkTitle(open);
    for (const id of OWN) this.#checkServer(id);
    if (!this.storeOff) for (const id of SCENES) await this.#checkKept(id);
  }

  #checkTitle(open: OpenTab): void {
    const { name, tab } = open;
    const { document } = tab.editor;
    const scene = document.scene.peek();
    if (!scene) return;
    if (document.shown.peek() !== scene) this.broken.push(`${name} shows a preview without a drag`);
    if (document.lock.peek()) return;
    const state = tab.saving.state.peek();
    const there = this.server.scenes.get(scene.id);
    const isThere = there !== undefined && versionOf(readScene(there.json)) === versionOf(scene);
    const says = `${name} says "${state}" of ${scene.id}`;
    if (scene.id === EXAMPLE) return;
    // A write elsewhere after the save appears with the next save.
    const overwritten = this.foreign.has(scene.id) && (!there || this.#isForeign(there.json));
    if (state === 'saved' && !isThere && !overwritten) this.broken.push(`${says}, which the server does not have`);
    if (state === 'saving' || state === 'example') this.broken.push(`${says} at rest`);
    if (state === 'conflict' && !this.foreign.has(scene.id) && !this.storeOff)
      this.broken.push(`${says}, which nobody else changed`);
    if (state !== 'saved' && state !== 'conflict') this.broken.push(`${says} although the server answers`);
  }

  /** A scene open in no tab is on the server as it was left, unless its tab was closed or another user wrote it. */
  #checkServer(id: string): void {
    const newest = this.#newest.get(id);
    if (!newest?.tab?.here || this.foreign.has(id)) return;
    if (this.tabs.some(({ tab }) => tab.editor.resting.peek()?.id === id)) return;
    const there = this.server.scenes.get(id);
    if (!there || versionOf(readScene(there.json)) !== versionOf(newest.scene))
      this.broken.push(`the server does not have the newest version of ${id}, which was left`);
  }

  /** Every step of an open tab is stored, or has grown since. */
  async #checkKept(id: string): Promise<void> {
    const kept = await this.store.read(id);
    const steps = new Map(kept?.steps.map((s) => [s.id, s]));
    for (const { scene, tab, step } of this.#entries) {
      if (scene !== id || !tab.here) continue;
      const now = steps.get(step.id);
      const grew = now && (now.revision ?? 0) > (step.revision ?? 0);
      if (!now || (!grew && now.at !== step.at)) this.broken.push(`step ${step.id} of ${id}, ${step.name}, is lost`);
    }
  }
}
