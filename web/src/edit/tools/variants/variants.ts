// Variants of the open scene: made, shown, kept, named and compared. The document lists them; their motions are stored
// here, and computed again where missing.
import { batch, computed, effect, signal, type ReadonlySignal } from '@preact/signals-core';
import { inOneStep } from '../../../model/document/commands';
import type { Futures, MotionSet } from '../../../model/document/futures';
import { sceneKey, touchedIn, type Agent, type Scene, type Variant } from '../../../model/document/scene';
import { countOf, valuesOf, withValue } from '../../../model/physics/sweep';
import {
  keepAsVariant,
  keepStates,
  MOST_NEW,
  patchVariant,
  removeVariant,
  replaceVariants,
  sameCast,
  stateOfVariant,
  takeVariant,
} from '../../../model/document/variants';
import type { Editor } from '../../session/editor';
import { cardsOf, filtered, isWhole, type Card, type VariantFilter, type WholeCard } from './cards';
import { Comparing } from './comparing';
import { begun, likeShown, nextSeed, reasonOf, withOne, withoutPick, type Making } from './making';
import { SweptRange } from './swept-range';
import { Maker, Stopped, subjectOf, type Take } from '../../asking/take-maker';
import { TEXTS } from '../../../texts/editing/variants';

/** Scope of an export: the scene itself, or several variants. */
export type VariantScope = 'present' | 'kept' | 'starred' | 'all' | 'pair';

/** Result of making variants. */
interface MakingResult {
  readonly subject: string | null;
  readonly why: string | null;
  readonly wanted: number;
  readonly stopped: boolean;
  /** They sweep a range of a number. */
  readonly ranged: boolean;
}

const USUAL_COUNT = 6;
/** Notices that this many were kept. */
const KEPT = { card: TEXTS.cardsKept, case: TEXTS.casesKept, present: () => TEXTS.keptAsAVariant } as const;
const NONE: readonly Card[] = Object.freeze([]);

/** Cards of a round, each as the document after it is taken. */
export interface DealtScenes {
  readonly id: string;
  readonly scenes: readonly Scene[];
  readonly futures: Futures;
}

export class Variants {
  readonly #open = signal(false);
  readonly #count = signal(USUAL_COUNT);
  readonly #filter = signal<VariantFilter>('all');
  readonly #current = signal<number | null>(null);
  readonly #renaming = signal<number | null>(null);
  readonly #scope = signal<VariantScope>('present');
  readonly #making = signal<Making | null>(null);
  readonly #sets = signal<ReadonlyMap<string, MotionSet>>(new Map());
  readonly #paused = signal(false);
  /** Increases with every stop. */
  #turn = 0;
  readonly #fetching = signal(false);

  readonly open: ReadonlySignal<boolean> = this.#open;
  /** Number to make at once. */
  readonly count: ReadonlySignal<number> = this.#count;
  readonly filter: ReadonlySignal<VariantFilter> = this.#filter;
  /** Id of the card being renamed. */
  readonly renaming: ReadonlySignal<number | null> = this.#renaming;
  readonly scope: ReadonlySignal<VariantScope> = this.#scope;
  readonly making: ReadonlySignal<Making | null> = this.#making;
  /** Is the making paused? */
  readonly paused: ReadonlySignal<boolean> = this.#paused;
  /** Subject of new variants; null for all road users. */
  readonly subject: ReadonlySignal<Agent | null>;
  /** Number of requested new variants. */
  readonly wanted = computed(() => {
    const sweep = this.range.sweep.value;
    return sweep ? countOf(sweep) : this.#count.value;
  });
  /** The range of a number that new variants sweep. */
  readonly range: SweptRange;
  /** Two variants side by side. */
  readonly comparing: Comparing;
  /** Is a variant being computed? */
  readonly busy = computed(() => this.#making.value !== null || this.#fetching.value);
  readonly cards: ReadonlySignal<readonly Card[]>;
  readonly filtered: ReadonlySignal<readonly Card[]>;
  /** Id of the shown variant. */
  readonly shown: ReadonlySignal<number | null>;
  /** Id of the card that keys act on: the focused one, else the shown one. */
  readonly current: ReadonlySignal<number | null>;

  constructor(
    private readonly editor: Editor,
    private readonly maker: Maker,
    private readonly cancel: () => void,
  ) {
    const list = computed(() => editor.resting.value?.variants);
    const states = computed(() => editor.resting.value?.variantStates);
    const cast = computed(() => `${editor.resting.value?.id} ${editor.resting.value?.castKey}`);
    this.cards = computed(() => {
      void cast.value;
      const scene = editor.scene.peek();
      const [all, of] = [list.value, states.value];
      return scene && all?.length && of
        ? cardsOf(scene, all, of, this.#sets.value, (a) => editor.view.unitOf(a))
        : NONE;
    });
    this.subject = computed(() => {
      const id = subjectOf(editor);
      return id === null ? null : (editor.scene.value?.agents.get(id) ?? null);
    });
    this.range = new SweptRange(editor, this.subject);
    this.filtered = computed(() => filtered(this.cards.value, this.#filter.value));
    const key = computed(() => {
      const scene = editor.drag.active.value ? null : editor.resting.value;
      return scene?.variants.length ? sceneKey(scene) : null;
    });
    this.shown = computed(() => {
      const now = key.value;
      return now === null ? null : (this.cards.value.find((c) => c.scene && sceneKey(c.scene) === now)?.id ?? null);
    });
    this.current = computed(() => {
      const id = this.#current.value;
      return id !== null && this.cards.value.some((c) => c.id === id) ? id : this.shown.value;
    });
    this.comparing = new Comparing(editor, this);
    let scene = '';
    effect(() => {
      const now = editor.resting.value?.id ?? '';
      if (now === scene) return;
      scene = now;
      this.#forget();
    });
    effect(() => {
      if (this.#open.value && !this.#making.value) void this.#fetchMissing(this.cards.value);
    });
  }

  card(id: number | null): Card | null {
    return this.cards.value.find((c) => c.id === id) ?? null;
  }

  // -------------------------------------------------------------- the strip

  show(open: boolean): void {
    batch(() => {
      this.#open.value = open;
      this.#renaming.value = null;
      this.comparing.unpick();
      if (!open) this.comparing.end();
    });
    if (!open) this.stop();
  }

  setCount(n: number): void {
    this.#count.value = Math.min(MOST_NEW, Math.max(1, Math.round(n)));
  }

  setFilter(filter: VariantFilter): void {
    this.#filter.value = filter;
  }

  /** The focused card. */
  focus(id: number | null): void {
    this.#current.value = id;
  }

  // -------------------------------------------------------------- making them

  /**
   * Replaces the variants that are not kept with new ones, as one step; the first of them is shown, except for a range.
   */
  async make(): Promise<void> {
    const { editor } = this;
    const scene = editor.scene.peek();
    if (!scene || this.#refusedLock()) return;
    this.stop();
    const turn = this.#turn;
    const subject = subjectOf(editor);
    const sweep = this.range.sweep.peek();
    const obstacle = this.range.obstacle.peek();
    if (sweep && obstacle) return editor.notices.show({ text: obstacle });
    const open = withoutPick(scene, subject);
    const values =
      sweep && subject !== null ? valuesOf(sweep).map((v) => withValue(open, subject, sweep.over, v)) : null;
    const wanted = this.wanted.peek();
    const source = values
      ? this.maker.each(values, subject!)
      : this.maker.make(open, subject, nextSeed(scene, subject), wanted);
    const { takes, why } = await this.#takesOf(source, subject, wanted, turn);
    const stopped = turn !== this.#turn;
    if (editor.scene.peek()?.id === scene.id)
      this.#put(takes, { subject, why, wanted, stopped, ranged: values !== null });
  }

  /** Takes in turn until the user stops it; waits while it is paused. */
  async #takesOf(
    source: AsyncGenerator<Take>,
    subject: string | null,
    of: number,
    turn: number,
  ): Promise<{ takes: Take[]; why: string | null }> {
    const takes: Take[] = [];
    let why: string | null = null;
    const from = performance.now();
    batch(() => {
      this.comparing.end();
      this.#open.value = true;
      this.#making.value = begun(of);
    });
    try {
      for await (const take of source) {
        if (turn !== this.#turn) break;
        takes.push(take);
        const tookS = (performance.now() - from) / 1000;
        this.#making.value = withOne(this.#making.peek() ?? begun(of), take, subject, tookS);
        await this.#resumed();
        if (turn !== this.#turn) break;
      }
    } catch (e) {
      why = reasonOf(e);
    }
    if (turn === this.#turn) this.#making.value = null;
    return { takes, why };
  }

  pause(paused: boolean): void {
    this.#paused.value = paused && this.#making.peek() !== null;
  }

  #resumed(): Promise<void> {
    if (!this.#paused.peek()) return Promise.resolve();
    return new Promise((go) => {
      const end = this.#paused.subscribe((paused) => {
        if (paused) return;
        queueMicrotask(() => end());
        go();
      });
    });
  }

  #put(takes: readonly Take[], { subject, why, wanted, stopped, ranged }: MakingResult): void {
    const { editor } = this;
    const { notices } = editor;
    const now = editor.scene.peek()!;
    const motion = editor.answers.motion.peek();
    // The user's own work is replaced by the variant of the shown future, else by the first, and can be kept beside the
    // new ones. Values of a range are shown beside the document's own.
    // A chosen future stays the scene's own, and the variants are beside it.
    const stays = ranged || (subject !== null && now.agents.get(subject)?.chosen != null);
    const isWork = !stays && this.shown.peek() === null && !motion.stale && touchedIn(now).length > 0;
    const was: Take = { scene: now, set: { ...motion, key: sceneKey(now) } };
    if (takes.length && takes[0].scene.castKey === now.castKey) {
      this.#keepSets(takes);
      const states = takes.map((t) => stateOfVariant(t.scene, subject));
      const put = replaceVariants(now, states);
      const shown = states[subject === null ? 0 : Math.max(0, likeShown(motion, takes, subject))];
      editor.commits.run(stays ? put : inOneStep(put, takeVariant(now, shown, put.name)));
      this.#current.value = null;
    }
    const n = takes.length;
    if (!n && stopped) return;
    const made = n ? TEXTS.variantsMade(n) : TEXTS.noVariantMade;
    const keep = { label: TEXTS.keepPrevious, run: () => this.keepTakes([was], null, 'present') };
    const text = stopped || n === wanted ? `${made}.` : TEXTS.moreWouldBeAlike(made);
    if (why) notices.show({ text: why });
    else notices.show({ text, undo: n > 0, ...(n && isWork ? { action: keep } : {}) });
    notices.say(`${made}.`);
  }

  /** Ends the making; variants made so far are kept. */
  stop(): void {
    this.#turn++;
    this.#making.value = null;
    this.#paused.value = false;
    this.cancel();
  }

  #keepSets(takes: readonly Take[]): void {
    const sets = new Map(this.#sets.peek());
    for (const { set } of takes) {
      sets.set(set.key, set);
      this.editor.answers.know(set);
    }
    this.#sets.value = sets;
  }

  /** Variants of an earlier session, and those restored by undo. */
  async #fetchMissing(cards: readonly Card[]): Promise<void> {
    if (this.#fetching.peek()) return;
    const next = cards.find((c) => c.scene && !c.set);
    if (!next) return;
    this.#fetching.value = true;
    const turn = this.#turn;
    let done = false;
    try {
      const take = await this.maker.again(next.id, next.scene!, next.state.subject);
      if (turn === this.#turn) this.#keepSets([take]);
      done = true;
    } catch (e) {
      if (!(e instanceof Stopped)) this.editor.notices.show({ text: reasonOf(e) ?? '' });
    } finally {
      this.#fetching.value = false;
    }
    if (done && this.#open.peek()) void this.#fetchMissing(this.cards.peek());
  }

  #forget(): void {
    batch(() => {
      this.stop();
      this.#sets.value = new Map();
      this.comparing.end();
      this.#current.value = this.#renaming.value = null;
      this.#filter.value = 'all';
      this.range.over(null);
    });
  }

  #refusedLock(): boolean {
    const lock = this.editor.document.lock.peek();
    if (lock) this.editor.notices.show({ text: lock.words, action: lock });
    return lock !== null;
  }

  // -------------------------------------------------------------- one variant

  /** Shows a variant. */
  take(id: number): void {
    const { editor } = this;
    const card = this.card(id);
    const scene = editor.scene.peek();
    if (!card || !scene || this.shown.peek() === id) return;
    if (!sameCast(scene, card.state)) {
      editor.notices.show({ text: TEXTS.otherRoadUsers });
      return;
    }
    if (card.set) editor.answers.know(card.set);
    editor.commits.run(takeVariant(scene, card.state, TEXTS.shown(card.name)));
  }

  toggleKept(id: number): void {
    this.#patch(id, (v, name) => ({
      patch: { kept: !v.kept },
      name: `${name} ${v.kept ? TEXTS.notKept : TEXTS.kept}`,
    }));
  }

  toggleStar(id: number): void {
    this.#patch(id, (v, name) => ({
      patch: { starred: !v.starred },
      name: v.starred ? TEXTS.unstarred(name) : TEXTS.starred(name),
    }));
  }

  rename(id: number, called: string): void {
    this.#renaming.value = null;
    const name = called.trim() || null;
    if (name === this.card(id)?.variant.called) return;
    this.#patch(id, (_, was) => ({ patch: { called: name }, name: TEXTS.named(was, name ?? TEXTS.automatically) }));
  }

  /** Variants within an export scope that have all their data. */
  within(scope: VariantScope): readonly WholeCard[] {
    const pair = this.comparing.pair.value;
    return this.cards.value.filter(isWhole).filter((c) => {
      if (scope === 'kept') return c.variant.kept;
      if (scope === 'starred') return c.variant.starred;
      return scope === 'all' || (scope === 'pair' && !!pair?.includes(c.id));
    });
  }

  /** The next export covers several: the kept ones, else all. */
  aimExport(): void {
    this.setScope(this.within('kept').length ? 'kept' : 'all');
  }

  setScope(scope: VariantScope): void {
    this.#scope.value = scope;
  }

  startRenaming(id: number | null): void {
    this.#renaming.value = id;
  }

  remove(id: number): void {
    const scene = this.editor.scene.peek();
    const card = this.card(id);
    if (scene && card) this.editor.commits.run(removeVariant(scene, id, TEXTS.removed(card.name)));
  }

  /** Makes the shown scene one of the variants. */
  keepPresent(): void {
    const { editor } = this;
    const scene = editor.scene.peek();
    const command = scene && keepAsVariant(scene, TEXTS.keptAsAVariant);
    if (!scene || !command) return;
    const set = editor.answers.motion.peek();
    if (!set.stale) this.#keepSets([{ scene, set: { ...set, key: sceneKey(scene) } }]);
    editor.commits.run(command);
    this.#open.value = true;
  }

  /** Adds the futures of a round to the variants, kept, each with the others' reactions. */
  async keepDealt({ id, scenes, futures }: DealtScenes): Promise<void> {
    const { editor } = this;
    if (!scenes.length || this.#refusedLock()) return;
    this.stop();
    const turn = this.#turn;
    const { takes, why } = await this.#takesOf(this.maker.each(scenes, id, futures), id, scenes.length, turn);
    if (why) editor.notices.show({ text: why });
    this.#join(takes, id);
  }

  /** Adds scenes of a round, or cases found for a road user, to the variants, kept. */
  keepTakes(
    takes: readonly Take[],
    subject: string | null = null,
    what: keyof typeof KEPT = 'card',
    starred: readonly boolean[] = [],
  ): void {
    if (!takes.length || this.#refusedLock()) return;
    batch(() => {
      this.stop();
      this.comparing.end();
      this.#open.value = true;
    });
    this.#join(takes, subject, what, starred);
  }

  #join(
    takes: readonly Take[],
    subject: string | null,
    what: keyof typeof KEPT = 'card',
    starred: readonly boolean[] = [],
  ): void {
    const { editor } = this;
    const now = editor.scene.peek();
    if (!takes.length || now?.id !== takes[0].scene.id || now.castKey !== takes[0].scene.castKey) return;
    const n = takes.length;
    const states = takes.map((t) => stateOfVariant(t.scene, subject));
    const command = keepStates(now, states, KEPT[what](n), starred);
    if (!command) return editor.notices.show({ text: TEXTS.thereIsNoRoom });
    this.#keepSets(takes);
    editor.commits.run(command);
  }

  #patch(id: number, make: (v: Variant, name: string) => { patch: Partial<Variant>; name: string }): void {
    const scene = this.editor.scene.peek();
    const card = this.card(id);
    if (!scene || !card) return;
    const { patch, name } = make(card.variant, card.name);
    this.editor.commits.run(patchVariant(scene, id, patch, name));
  }
}
