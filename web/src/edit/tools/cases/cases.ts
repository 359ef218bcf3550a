// The search for a case: its target, progress and results. It uses the scene at its start; the document stays unchanged
// until the user takes a case.
import { batch, computed, effect, signal, type ReadonlySignal } from '@preact/signals-core';
import { mayBeCase, type MayChange, type Try } from '../../../model/physics/case-search';
import { alike, KINDS, momentOf, type Moment, type Sought, type What } from '../../../model/physics/cases';
import { momentWords } from '../../../model/words/case-words';
import { findChanges } from '../../../model/words/change-words';
import type { MotionSet } from '../../../model/document/futures';
import type { Motion } from '../../../model/base/motion';
import { canMove, type Scene } from '../../../model/document/scene';
import type { Vec } from '../../../model/base/geometry';
import { stateOfVariant, takeVariant } from '../../../model/document/variants';
import { Away, Refused } from '../../../net/client';
import type { Problem } from '../../../net/types';
import type { Editor } from '../../session/editor';
import type { SceneBeside, Tries } from '../../session/view-settings';
import { Stopped, type Take } from '../../asking/take-maker';
import { OF_A_CALL, type CaseTries, type SearchOf } from './tries';
import { TEXTS } from '../../../texts/editing/cases';

/** A result: the motions of all, the moment in question, and the number of similar cases. */
export interface Case {
  /** Increases in the order of discovery. */
  readonly id: number;
  readonly take: Take;
  readonly moment: Moment;
  readonly like: number;
  readonly starred: boolean;
}

export interface Progress {
  readonly tried: number;
  readonly of: number;
  readonly collisions: number;
  readonly found: number;
  /** Estimated seconds left, from the first tries; null at the start. */
  readonly left: number | null;
}

export type SearchState = 'ready' | 'running' | 'paused' | 'done';

/** Number of tries before the user must continue the search, and number of cases that end it. */
export const MOST_TRIES = 300;
export const ENOUGH = 6;
const NOTHING: Progress = { tried: 0, of: MOST_TRIES, collisions: 0, found: 0, left: null };
const SOONER_MS = 50;
/** Tried paths are drawn with one point for this many steps, and only the newest of them. */
const WAY_STEPS = 4;
const MOST_WAYS = 360;

export class Cases {
  readonly #open = signal(false);
  readonly #sought = signal<Sought | null>(null);
  readonly #may = signal<MayChange>({ speed: true, time: true, seed: true, place: false });
  readonly #state = signal<SearchState>('ready');
  readonly #progress = signal<Progress>(NOTHING);
  readonly #found = signal<readonly Case[]>([]);
  readonly #closest = signal<Case | null>(null);
  readonly #shown = signal<number | null>(null);
  readonly #problem = signal<string | null>(null);
  readonly #from = signal<{ readonly scene: Scene; readonly set: MotionSet; readonly at: Date } | null>(null);
  /** The case shown from here; another owner's overlay is not removed. */
  #beside: SceneBeside | null = null;
  /** Increases with every stop. */
  #turn = 0;
  /** Calls for this target. */
  #calls = 0;
  /** Ends the running call. */
  #over = new AbortController();
  /** Least distance from the condition of the tries that were shown as the closest. */
  #leastMiss = Infinity;

  readonly isOpen: ReadonlySignal<boolean> = this.#open;
  readonly sought: ReadonlySignal<Sought | null> = this.#sought;
  readonly may: ReadonlySignal<MayChange> = this.#may;
  readonly state: ReadonlySignal<SearchState> = this.#state;
  readonly progress: ReadonlySignal<Progress> = this.#progress;
  /** Nearest to the target first. */
  readonly found: ReadonlySignal<readonly Case[]> = this.#found;
  /** Without a result: the closest attempt. */
  readonly closest: ReadonlySignal<Case | null> = this.#closest;
  /** Id of the shown case. */
  readonly shown: ReadonlySignal<number | null> = this.#shown;
  readonly problem: ReadonlySignal<string | null> = this.#problem;
  /** The searched scene, and when the search began. */
  readonly from: ReadonlySignal<{ readonly scene: Scene; readonly at: Date } | null> = this.#from;
  /** Has the document changed since the search began? */
  readonly outdated = computed(() => {
    const from = this.#from.value;
    return from !== null && this.editor.scene.value !== from.scene;
  });

  constructor(
    private readonly editor: Editor,
    private readonly tries: Pick<CaseTries, 'search' | 'open' | 'cancel'>,
  ) {
    const scene = computed(() => editor.resting.value?.id);
    effect(() => {
      void scene.value;
      this.close();
    });
  }

  // -------------------------------------------------------------- target

  /** Opens the search for the selected road users: the first is varied, the second is the other party. */
  open(what?: What, ids: readonly string[] = this.editor.selected.peek()): void {
    const scene = this.editor.scene.peek();
    const [who, other] = ids.filter((id) => scene?.agents.has(id));
    if (!scene || !who) return;
    const kind = what ?? (other ? 'near' : scene.agents.get(who)!.goal.pos ? 'goal' : 'braking');
    batch(() => {
      this.close();
      this.#open.value = true;
      this.seek({ what: kind, who, other: other ?? null, limit: KINDS[kind].limit });
    });
  }

  /** Changes the target; earlier results are dropped. */
  seek(sought: Sought): void {
    const kind = KINDS[sought.what];
    const [least, most] = kind.range;
    batch(() => {
      this.stop();
      this.#sought.value = Object.freeze({ ...sought, limit: Math.min(most, Math.max(least, sought.limit)) });
      this.#forget();
    });
  }

  setKind(what: What): void {
    const s = this.#sought.peek();
    if (s) this.seek({ ...s, what, limit: KINDS[what].limit });
  }

  /** Swaps the two: the other one is varied. */
  swap(): void {
    const s = this.#sought.peek();
    if (s?.other) this.seek({ ...s, who: s.other, other: s.who });
  }

  toggleMay(what: keyof MayChange): void {
    const next = { ...this.#may.peek(), [what]: !this.#may.peek()[what] };
    const s = this.#sought.peek();
    if (!Object.values(next).some(Boolean) || !s) return;
    this.#may.value = Object.freeze(next);
    this.seek(s);
  }

  /** Why the search cannot begin; null where it can. */
  readonly obstacle = computed<string | null>(() => {
    const s = this.#sought.value;
    const scene = this.editor.scene.value;
    const who = s && scene?.agents.get(s.who);
    if (!s || !who) return TEXTS.selectOneOrTwo;
    if (!canMove(who)) return `${who.name} ${who.locked ? TEXTS.isLocked : TEXTS.isNotEditable}.`;
    if (KINDS[s.what].two && s.other === null) return TEXTS.needsTwo;
    if (s.what === 'red' && !scene?.signals.length) return TEXTS.noSignalsHere;
    if (s.what === 'goal' && !who.goal.pos) return TEXTS.hasNoGoalYet(who.name);
    return null;
  });

  // -------------------------------------------------------------- the search

  /** Begins, or continues for as many tries again. */
  async run(): Promise<void> {
    const { editor } = this;
    const sought = this.#sought.peek();
    const scene = this.#from.peek()?.scene ?? editor.scene.peek();
    if (!sought || !scene || this.obstacle.peek() || this.#state.peek() === 'running') return;
    const turn = ++this.#turn;
    batch(() => {
      this.#from.value ??= { scene, set: editor.answers.motion.peek(), at: new Date() };
      this.#problem.value = null;
      this.#state.value = 'running';
      const { tried, of } = this.#progress.peek();
      this.#progress.value = { ...this.#progress.peek(), of: tried >= of ? of + MOST_TRIES : of };
    });
    const { set } = this.#from.peek()!;
    try {
      await this.#tryAll({ scene, set, sought, may: this.#may.peek() }, turn);
    } catch (e) {
      if (!(e instanceof Stopped) && turn === this.#turn) this.#fail(e);
    }
    if (turn === this.#turn) this.#end();
  }

  async #tryAll(of: SearchOf, turn: number): Promise<void> {
    const began = { ms: performance.now(), tried: this.#progress.peek().tried };
    for (let left = this.#left(); left > 0; left = this.#left()) {
      await this.#quiet();
      if (turn !== this.#turn) return;
      this.#over = new AbortController();
      let tries = 0;
      let results = 0;
      let failed = '';
      for await (const tried of this.tries.search(of, this.#calls++, Math.min(left, OF_A_CALL), this.#over.signal)) {
        if (turn !== this.#turn) return;
        tries++;
        if (tried.code !== undefined) results++;
        failed = tried.problem ?? failed;
        await this.#look(of, tried, turn);
        if (turn !== this.#turn) return;
        this.#count(began);
        if (!this.#left()) return;
      }
      if (!results && failed) throw new Refused(422, { code: failed as Problem['code'], title: failed });
      if (!tries) {
        // Nothing else can be tried.
        this.#progress.value = { ...this.#progress.peek(), of: this.#progress.peek().tried };
        return;
      }
    }
  }

  /** Tries that are left; 0 where enough is found. */
  #left(): number {
    const { tried, of } = this.#progress.peek();
    return this.#found.peek().length < ENOUGH ? of - tried : 0;
  }

  /** Shows the searched paths on the picture. */
  #draw(motions: readonly Motion[]): void {
    const all: Tries = [...this.editor.view.tries.peek(), ...motions.map(wayOf)];
    this.editor.view.showTries(Object.freeze(all.slice(-MOST_WAYS)));
  }

  /** Makes a try again that may be a case, and without a result so far one that comes nearer. */
  async #look(of: SearchOf, tried: Try, turn: number): Promise<void> {
    const { sought } = of;
    const { miss = Infinity } = tried;
    const nearer = this.#found.peek().length === 0 && miss < this.#leastMiss;
    const counts = sought.what !== 'collision' && sought.what !== 'red';
    const crashed = counts && (tried.figures['actor.collisions'] ?? 0) > 0;
    let found = false;
    if (mayBeCase(tried, sought) || nearer) {
      this.#leastMiss = Math.min(miss, this.#leastMiss);
      await this.#quiet();
      if (turn !== this.#turn) return;
      for await (const take of this.tries.open(of, tried)) {
        if (turn !== this.#turn) return;
        this.#draw((take.set.futures.get(sought.who)?.modes ?? []).map((m) => m.motion));
        found = this.#judge(take, sought);
        if (found) break;
      }
    }
    if (!found && crashed)
      this.#progress.value = { ...this.#progress.peek(), collisions: this.#progress.peek().collisions + 1 };
  }

  /** Is it a case? A try counts as one case at most. */
  #judge(take: Take, sought: Sought): boolean {
    const moment = momentOf(take.scene, take.set, sought);
    if (!moment) return false;
    const id = 1 + Math.max(0, ...this.#found.peek().map((c) => c.id));
    const fresh: Case = { id, take, moment, like: 0, starred: false };
    if (!moment.found) {
      if (moment.miss < (this.#closest.peek()?.moment.miss ?? Infinity)) this.#closest.value = fresh;
      return false;
    }
    const known = this.#found.peek();
    const same = known.find((c) => alike(c.moment, moment));
    const next = same
      ? known.map((c) => (c === same ? { ...c, like: c.like + 1 } : c))
      : [...known, fresh].sort((p, q) => p.moment.miss - q.moment.miss || p.id - q.id);
    batch(() => {
      this.#found.value = Object.freeze(next);
      this.#progress.value = { ...this.#progress.peek(), found: this.#progress.peek().found + 1 };
    });
    if (!same) this.editor.notices.say(TEXTS.caseSaid(id, momentWords(sought, moment)));
    return true;
  }

  #count(began: { ms: number; tried: number }): void {
    const now = this.#progress.peek();
    const tried = now.tried + 1;
    const each = (performance.now() - began.ms) / 1000 / (tried - began.tried);
    this.#progress.value = { ...now, tried, left: (now.of - tried) * each };
  }

  /** A drag goes first: no request is sent until it ends. */
  async #quiet(): Promise<void> {
    while (this.editor.drag.active.peek()) await new Promise((done) => setTimeout(done, SOONER_MS));
  }

  #fail(e: unknown): void {
    if (!(e instanceof Refused) && !(e instanceof Away)) throw e;
    this.#problem.value = e instanceof Refused ? e.message : TEXTS.theGenerator;
  }

  #end(): void {
    const { notices } = this.editor;
    const found = this.#found.peek().length;
    const { tried, of } = this.#progress.peek();
    const through = tried >= of || found >= ENOUGH;
    this.#state.value = through ? 'done' : 'paused';
    if (through) notices.say(found ? TEXTS.casesFound(found) : TEXTS.nothingFound(tried));
  }

  /** Drops running requests; results stay, and the search can continue. */
  stop(): void {
    if (this.#state.peek() !== 'running') return;
    this.#turn++;
    this.#state.value = 'paused';
    this.#over.abort();
    this.tries.cancel();
  }

  #forget(): void {
    batch(() => {
      this.#state.value = 'ready';
      this.#progress.value = NOTHING;
      this.#found.value = [];
      this.#closest.value = this.#problem.value = this.#from.value = null;
      this.#calls = 0;
      this.#leastMiss = Infinity;
      this.editor.view.showTries([]);
      this.show(null);
    });
  }

  close(): void {
    batch(() => {
      this.stop();
      this.#open.value = false;
      this.#sought.value = null;
      this.#forget();
    });
  }

  // -------------------------------------------------------------- results

  caseOf(id: number | null): Case | null {
    return this.#found.peek().find((c) => c.id === id) ?? null;
  }

  /** Shows a case dashed beside the current scene, at its moment; it follows the playhead. */
  show(id: number | null): void {
    const { editor } = this;
    const c = this.caseOf(id);
    this.#shown.value = c?.id ?? null;
    if (!c) {
      if (this.#beside && editor.view.beside.peek() === this.#beside) editor.view.showBeside(null);
      this.#beside = null;
      return;
    }
    const sought = this.#sought.peek()!;
    this.#beside = { ...c.take, diverging: this.#diverging(c), meeting: meetingOf(c, sought) };
    editor.view.showBeside(this.#beside);
    editor.playhead.pause();
    editor.playhead.moveTo(c.moment.time);
  }

  /** The next or the previous case of the list. */
  walk(step: 1 | -1): void {
    const all = this.#found.peek();
    const at = all.findIndex((c) => c.id === this.#shown.peek());
    const next = all[at < 0 ? 0 : Math.min(all.length - 1, Math.max(0, at + step))];
    if (next) this.show(next.id);
  }

  /** Road users of the moment, and all others with another motion. */
  #diverging({ take, moment }: Case): string[] {
    const sought = this.#sought.peek()!;
    const now = this.editor.answers.motion.peek();
    const others = findChanges(take.scene, now, take.set, new Set([sought.who])).map((c) => c.id);
    return [...new Set([sought.who, ...(moment.other === null ? [] : [moment.other]), ...others])];
  }

  /** Takes a case as the motion of the scene: one step, which can be undone. */
  take(c: Case): void {
    const { editor } = this;
    const now = editor.scene.peek();
    const sought = this.#sought.peek();
    if (!now || !sought || now.id !== c.take.scene.id) return;
    if (now.castKey !== c.take.scene.castKey) {
      editor.notices.show({ text: TEXTS.otherRoadUsers });
      return;
    }
    this.show(null);
    editor.answers.know(c.take.set);
    const name = TEXTS.caseUsed(momentWords(sought, c.moment));
    editor.commits.run({ ...takeVariant(now, stateOfVariant(c.take.scene, sought.who), name), fold: undefined });
    editor.playhead.moveTo(c.moment.time);
    editor.notices.show({ text: `${name}.`, undo: true });
  }

  toggleStar(id: number): void {
    const all = this.#found.peek();
    this.#found.value = Object.freeze(all.map((c) => (c.id === id ? { ...c, starred: !c.starred } : c)));
  }

  /** The results for keeping, with their stars. */
  takes(): { readonly subject: string; readonly takes: readonly Take[]; readonly starred: readonly boolean[] } | null {
    const sought = this.#sought.peek();
    const found = this.#found.peek();
    return sought && { subject: sought.who, takes: found.map((c) => c.take), starred: found.map((c) => c.starred) };
  }
}

/** A path with fewer points than the motion has steps; at 10 steps a second the difference is invisible. */
const wayOf = (m: Motion): Vec[] =>
  Array.from({ length: Math.ceil(m.x.length / WAY_STEPS) }, (_, i): Vec => [m.x[i * WAY_STEPS], m.y[i * WAY_STEPS]]);

const meetingOf = (c: Case, sought: Sought): NonNullable<SceneBeside['meeting']> => ({
  words: TEXTS.caseOnTag(c.id, momentWords(sought, c.moment)),
  at: c.moment.at,
  time: c.moment.time,
  who: c.moment.other === null ? [sought.who] : [sought.who, c.moment.other],
  called: TEXTS.called(c.id),
});
