// The generator behind the HTTP API: one request under way, one waiting, the newest wins.
import type { SceneJson } from '../model/document/scene-json';
import type { Client } from './client';
import type { Counting, Generator, Question, SceneRef, Trajectories } from './generator';
import type { EventReply, Transport } from './http-transport';
import { waitOf } from './problem';
import type { ScoreReply } from './types';

interface RunningQuestion {
  question: Question;
  /** Time of sending, milliseconds. */
  asked: number;
  /**
   * Does it refer to its scene by name? One that contains the scene keeps the server busy before it can be overtaken.
   */
  named: boolean;
  revision: number;
  abort: AbortController;
  drawn: boolean;
  /** Time since the last result, keep-alive messages excluded. */
  idle: number;
}

/** Limits of silence: called slow, probed, and taken for unreachable in any case. */
export interface Patience {
  slow: number;
  look: number;
  lost: number;
  tick: number;
  alive: () => Promise<boolean>;
}

/** `lost` is longer than the time between two keep-alive messages of a stream. */
const PATIENCE: Omit<Patience, 'alive'> = { slow: 2000, look: 6500, lost: 13000, tick: 250 };

/**
 * A first visible result is assumed to be under way after this multiple of the quickest of the last few, plus a margin.
 */
const SURELY = { of: 8, times: 1.25, more_ms: 2 };

/** A busy server answers a probe within this time. */
const PROBE_MS = 1500;

const RETRY_IN_PLACE = new Set(['unknown-map', 'stale-etag', 'not-found']);

export class HttpGenerator implements Generator {
  private running: RunningQuestion | null = null;
  private waiting: Question | null = null;
  /** An overtaken drag question whose first visible result is under way. */
  private passed: RunningQuestion | null = null;
  /** Delays of the last first visible results, milliseconds. */
  private readonly firsts: number[] = [];
  /** Was a question overtaken since the last drawn result? */
  private guessed = false;
  private revision = 0;
  /** Identifies this editor on the server, so that its newer questions overtake older ones. */
  private readonly name = `editor-${Math.random().toString(36).slice(2, 10)}`;
  private readonly patience: Patience;
  private readonly texts = new WeakMap<SceneJson, string>();
  /** Scenes that the server holds, by the names it gave: a drag sends its surroundings once. */
  private readonly held = new WeakMap<SceneJson, string>();
  /** Duration of silence, across questions that replaced each other. */
  private silent = 0;

  constructor(
    private readonly client: Client,
    private readonly line: Transport,
    patience: Partial<Patience> = {},
    private readonly now = () => performance.now(),
  ) {
    this.patience = { ...PATIENCE, alive: () => client.answers(PROBE_MS), ...patience };
  }

  answers(): Promise<boolean> {
    return this.client.answers();
  }

  score(scene: SceneRef, trajectories: Trajectories, what: Counting, signal: AbortSignal): Promise<ScoreReply> {
    const motions = Object.keys(trajectories).length ? { trajectories } : {};
    const part = 'id' in scene ? { scene_id: scene.id } : { scene: scene.scene };
    return this.client.score({ ...part, ...motions, ...what }, signal);
  }

  get busy(): boolean {
    return this.running !== null;
  }

  ask(ask: Question): void {
    // A preview without a visible result may finish its first draft: aborting it on every pointer move would leave a
    // drag without any drawing.
    if (this.running && ask.preview && this.running.question.preview && !this.running.drawn) {
      this.waiting?.on.dropped?.();
      this.waiting = ask;
      if (this.isAnswered(this.running)) this.pass(this.running);
      return;
    }
    this.waiting?.on.dropped?.();
    this.waiting = null;
    this.stopRunning();
    void this.run(ask);
  }

  /** Has a visible result surely left the server? Never assumed twice in a row: something must be drawn. */
  private isAnswered(r: RunningQuestion): boolean {
    if (!r.named || this.passed || this.guessed || this.firsts.length < SURELY.of) return false;
    return this.now() - r.asked > SURELY.times * Math.min(...this.firsts) + SURELY.more_ms;
  }

  /** The next question overtakes one without a result so far, which is still read. */
  private pass(r: RunningQuestion): void {
    this.passed = r;
    this.guessed = true;
    this.next();
  }

  /** A first visible result arrived: a draft, or the answer where that was as quick. */
  private noteDrawn(r: RunningQuestion, ms: number): void {
    this.guessed = false;
    if (!r.drawn && r.question.preview) {
      this.firsts.push(ms);
      if (this.firsts.length > SURELY.of) this.firsts.shift();
    }
    r.drawn = true;
  }

  private forgetPassed(): void {
    const r = this.passed;
    this.passed = null;
    // The assumption was wrong: it was not under way yet. No assumptions for a while.
    if (r && !r.drawn) this.firsts.length = 0;
    r?.abort.abort();
    r?.question.on.dropped?.();
  }

  /** Cancels all questions under way. */
  cancel(): void {
    this.waiting?.on.dropped?.();
    this.waiting = null;
    this.stopRunning();
    this.silent = 0;
  }

  private stopRunning(): void {
    this.forgetPassed();
    const r = this.running;
    this.running = null;
    r?.abort.abort();
    r?.question.on.dropped?.();
  }

  private async run(ask: Question): Promise<void> {
    const me: RunningQuestion = {
      question: ask,
      asked: this.now(),
      named: false,
      revision: ++this.revision,
      abort: new AbortController(),
      drawn: false,
      idle: this.silent,
    };
    this.running = me;
    const unwatch = this.watch(me);
    const mine = () => this.running === me || this.passed === me;
    const began = this.now();
    try {
      const scene = ask.scene();
      const name = 'id' in scene ? scene.id : this.held.get(scene.scene);
      me.named = name !== undefined;
      let answer = await this.post(name === undefined ? scene : { id: name }, me);
      if (answer.problem?.code === 'not-found' && 'scene' in scene && me.named) {
        // The server has dropped it, or was restarted.
        this.held.delete(scene.scene);
        me.named = false;
        me.revision = ++this.revision;
        answer = await this.post(scene, me);
      }
      const { status, problem } = answer;
      if (problem && (status === 422 || status === 412 || status === 404)) {
        const badMap = RETRY_IN_PLACE.has(problem.code) || problem.errors?.some((e) => e.code === 'unknown-map');
        if (!badMap) {
          if (mine()) ask.on.refused(problem);
          return;
        }
        me.revision = ++this.revision;
        answer = await this.post({ scene: ask.whole() }, me);
      }
      if (answer.problem) {
        const { problem: p, status: code } = answer;
        if (!mine()) return;
        const wait = waitOf(p);
        if (wait !== null) return await this.later(ask, me, wait / 1000);
        if (code === 409) ask.on.dropped?.();
        else if (code >= 502 && code <= 504) ask.on.away();
        else ask.on.refused(p);
        return;
      }
      await this.read(answer, me, began);
    } catch (e) {
      if (!mine()) return;
      if ((e as Error).name === 'AbortError' || this.passed === me) ask.on.dropped?.();
      else ask.on.away();
    } finally {
      unwatch();
      if (this.passed === me) this.forgetPassed();
      if (this.running === me) {
        this.running = null;
        this.silent = 0;
        this.next();
      }
    }
  }

  /**
   * Watches a question while it is open. Time is counted in ticks, so that a computer's sleep does not count as the
   * generator's absence.
   */
  private watch(me: RunningQuestion): () => void {
    const { slow, look, lost, tick, alive } = this.patience;
    let looked = false;
    let told = 0;
    const timer = setInterval(() => {
      if (this.running !== me) return;
      me.idle += tick;
      this.silent += tick;
      if (this.silent >= lost) return this.lose(me);
      if (me.idle < told) told = 0;
      if (me.idle >= slow && me.idle - told >= 4 * tick) me.question.on.slow?.((told = me.idle));
      if (this.silent < look) looked = false;
      else if (!looked) {
        looked = true;
        void alive().then((yes) => {
          if (!yes && this.running === me && this.silent >= look) this.lose(me);
        });
      }
    }, tick);
    return () => clearInterval(timer);
  }

  private lose(me: RunningQuestion): void {
    this.forgetPassed();
    this.running = null;
    this.silent = 0;
    me.abort.abort();
    this.waiting?.on.dropped?.();
    this.waiting = null;
    me.question.on.away();
  }

  /** The queue is full for a moment: a preview is dropped, a change is sent again later. */
  private async later(ask: Question, me: RunningQuestion, seconds: number): Promise<void> {
    if (ask.preview) {
      ask.on.dropped?.();
      return;
    }
    this.silent = 0;
    await new Promise((r) => setTimeout(r, Math.min(5, seconds) * 1000));
    if (this.running === me) await this.run(ask);
  }

  private async post(scene: SceneRef, me: RunningQuestion): Promise<EventReply> {
    const hold = 'scene' in scene && me.question.preview;
    const rest = JSON.stringify({
      client: this.name,
      revision: me.revision,
      futures: 'compact',
      ...(hold ? { hold } : {}),
      ...me.question.options,
    });
    const part = 'id' in scene ? `"scene_id":${JSON.stringify(scene.id)}` : `"scene":${this.textOf(scene.scene)}`;
    const answer = await this.line(`{${part},${rest.slice(1)}`, me.abort.signal);
    if (hold && answer.held !== undefined) this.held.set(scene.scene, answer.held);
    return answer;
  }

  /** A drag sends sixty requests a second with the same surroundings; they are serialised once. */
  private textOf(scene: SceneJson): string {
    const known = this.texts.get(scene);
    if (known !== undefined) return known;
    const text = JSON.stringify(scene);
    this.texts.set(scene, text);
    return text;
  }

  private async read(answer: EventReply, me: RunningQuestion, began: number): Promise<void> {
    const { on } = me.question;
    let shown = -1,
      window = 0;
    let ended = false;
    for await (const e of answer.events) {
      if (this.running !== me && this.passed !== me) return;
      this.silent = 0;
      if (e.event === 'heartbeat') continue;
      // Events of an older question are dropped without a flash.
      if (e.revision !== undefined && e.revision !== me.revision) continue;
      const ms = this.now() - began;
      me.idle = 0;
      if (e.event === 'initial' || e.event === 'step') {
        const step = e.event === 'initial' ? 0 : (e.step ?? shown + 1);
        // A later planning window begins with its own first draft.
        if (e.window < window || (e.window === window && step <= shown)) continue;
        window = e.window;
        shown = step;
        this.noteDrawn(me, ms);
        on.draft(e, step, e.steps, ms);
        // Of two under way, the older one has shown its result, or is too late for it.
        this.forgetPassed();
        if (this.running !== me) return;
        if (this.waiting) {
          this.stopRunning();
          this.next();
          return;
        }
      } else if (e.event === 'final') {
        ended = true;
        this.noteDrawn(me, ms);
        on.final(e, ms);
        if (this.passed === me) this.passed = null;
        else this.forgetPassed();
      } else if (e.event === 'error') {
        ended = true;
        on.refused(e.problem);
      } else if (e.event === 'superseded') {
        ended = true;
        on.dropped?.();
      }
    }
    if (ended) return;
    if (this.running === me) on.away();
    else if (this.passed === me) on.dropped?.();
  }

  private next(): void {
    const ask = this.waiting;
    this.waiting = null;
    if (ask) void this.run(ask);
  }
}
