// From the document to the generator and back: what is asked when, and what becomes of the answers.
import { batch } from '@preact/signals-core';
import type { Editor } from './editor';
import type { Library } from './library';
import { Generator, type Handlers } from '../net/generator';
import type { DraftEvent, FinalEvent, Problem } from '../net/types';
import { Away, type Client } from '../net/client';
import type { ConditionJson, SceneJson } from '../model/json';
import { conditionOf, generatedJson, isEmptyCondition, stillAgents, trackJson } from '../model/write';
import { readFutures, type Futures, type KeepOrder, type MotionSet } from '../model/futures';
import { canChange, GOAL_TIME, sceneKey, startPose, touched, type Agent, type Scene } from '../model/scene';
import { DEFAULTS } from '../model/domain';
import { motionOf } from '../model/changes';
import { summary, readEvents } from '../model/events';
import { motionFrom } from '../model/motion';
import { firstPose } from '../model/read';
import { readReach, readScore, readWarnings } from './answers';
import { sketchFutures } from './sketch';

/** Length and re-planning, as the API says them; 9 s in one go needs no words. */
const rollout = (s: Scene): { horizon_s?: number; replan_interval_s?: number } =>
  s.length > GOAL_TIME || s.replan < GOAL_TIME ? { horizon_s: s.length, replan_interval_s: s.replan } : {};

/** Which seconds a later window is about. */
const partOf = (s: Scene, window: number): string =>
  `${window * s.replan} to ${Math.min(s.length, (window + 1) * s.replan)} s`;

const RETRY_S = [1, 2, 4, 6];
const STEPS = DEFAULTS.steps;
/** A key held down sends one request when it rests. */
const REST_MS = 80;
/** A server that is only busy says so within this time. */
const PROBE_MS = 1500;

type Keep = (a: Agent) => KeepOrder;

interface Wanted {
  agents: string[] | 'all';
  react: boolean | string[];
  commit: { name: string; agent: string | null; undo: boolean } | null;
  kept?: ReadonlySet<string>;
  unscored?: boolean;
}

export class Asking {
  readonly generator: Generator;
  private readonly calm =
    typeof matchMedia === 'undefined' ? { matches: false } : matchMedia('(prefers-reduced-motion: reduce)');
  private restTimer = 0;
  private retryTimer = 0;
  private tries = 0;
  private missed = 0;
  private scoreAbort: AbortController | null = null;
  private partCache: { set: MotionSet; others: string; text: string } | null = null;

  constructor(
    private readonly editor: Editor,
    private readonly library: Library,
    private readonly client: Client,
    base = '',
  ) {
    this.generator = new Generator(base, undefined, { alive: () => client.answers(PROBE_MS) });
    editor.onCommit = (scene, step) => this.committed(scene, step);
    editor.onSelect = (id) => this.selected(id);
  }

  /** A road user was selected: its six futures, nobody else moves. */
  private selected(id: string | null): void {
    const { editor } = this;
    if (!id) {
      // A running answer to a commit must still arrive; only a look at futures is dropped.
      if (editor.motion.peek().stale) return;
      this.generator.cancel();
      // What was said about its futures goes with it.
      if (['refining', 'slow', 'settled'].includes(editor.status.peek().kind)) editor.status.value = { kind: 'ready' };
      return;
    }
    const a = editor.agent.peek();
    if (!a || !canChange(a) || editor.motion.peek().futures.has(id) || editor.motion.peek().stale) return;
    this.send({ agents: [id], react: false, commit: null }, true);
  }

  /** A drag frame: the newest pose, one request on the way and one waiting. */
  preview(id: string): void {
    const { editor } = this;
    if (editor.away.peek()) {
      const s = editor.scene.peek(),
        a = s?.agents.get(id);
      const f = s && a ? sketchFutures(s, a) : null;
      if (f) editor.draft.value = { id, futures: f, earlier: [] };
      return;
    }
    this.send({ agents: [id], react: false, commit: null }, true);
  }

  /** Drops the previews of a drag that was put back. */
  cancelPreviews(): void {
    this.generator.cancel();
    // A drag that began while a change was being worked out has pushed that aside; it is asked for again.
    if (this.editor.motion.peek().stale && !this.editor.away.peek())
      this.workOut({ name: 'Change', agent: this.editor.selection.peek(), undo: true });
  }

  private committed(scene: Scene, step: { name: string; agent: string | null; undo: boolean }): void {
    const { editor } = this;
    this.library.changed(scene);
    clearTimeout(this.restTimer);
    if (!editor.motion.peek().stale) {
      this.generator.cancel();
      editor.status.value = { kind: 'ready' };
      this.selected(editor.selection.peek());
      return;
    }
    if (editor.away.peek()) {
      this.missed++;
      editor.away.value = { ...editor.away.peek()!, waiting: this.missed };
      if (step.agent) this.sketch(step.agent);
      return;
    }
    this.restTimer = setTimeout(() => this.workOut(step), REST_MS) as unknown as number;
  }

  /** Release, typed value, undo to an unknown state: the others are asked too. */
  private workOut(step: { name: string; agent: string | null; undo: boolean }): void {
    const scene = this.editor.scene.peek();
    if (!scene) return;
    const mine = this.editor.touchedIds(scene);
    if (!mine.length) return this.pristine(scene, step);
    const chosen = [...scene.agents.values()].filter((a) => a.chosen !== null);
    if (scene.others !== 'react') return this.workOutAlone(scene, mine, step);
    const subject = step.agent && scene.agents.get(step.agent);
    if (subject && subject.chosen !== null && this.editor.motion.peek().futures.has(subject.id)) {
      // A picked future is kept as it is; everybody else answers it.
      const rest = [...scene.agents.values()].filter((a) => canChange(a) && a.chosen === null).map((a) => a.id);
      if (rest.length)
        this.send({ agents: rest, react: false, commit: step, kept: new Set(chosen.map((a) => a.id)) }, false);
      else void this.rescore(step);
      return;
    }
    const first = subject && touched(subject) ? subject.id : mine[0];
    const react = chosen.length
      ? [...scene.agents.values()].filter((a) => canChange(a) && a.chosen === null && a.id !== first).map((a) => a.id)
      : true;
    this.send(
      { agents: [first], react, commit: step, kept: new Set(chosen.filter((a) => a.id !== first).map((a) => a.id)) },
      false,
    );
  }

  private workOutAlone(scene: Scene, mine: string[], step: Wanted['commit']): void {
    const known = this.editor.motion.peek().futures;
    const open = mine.filter((id) => scene.agents.get(id)!.chosen === null || !known.has(id));
    if (open.length)
      this.send(
        { agents: open, react: false, commit: step, kept: new Set(mine.filter((id) => !open.includes(id))) },
        false,
      );
    else void this.rescore(step);
  }

  /** Nobody is asked anything: everybody follows the log again, or, past its end, makes a way of their own. */
  private pristine(scene: Scene, step: Wanted['commit']): void {
    if (scene.length > GOAL_TIME && scene.others === 'react')
      return this.send({ agents: 'all', react: false, commit: step }, false);
    const set: MotionSet = {
      key: sceneKey(scene),
      futures: new Map(),
      driving: new Set(),
      score: null,
      reach: new Map(),
      stale: false,
    };
    this.editor.settle(set, null);
    void this.rescore(step);
    if (this.editor.selection.peek()) this.selected(this.editor.selection.peek());
  }

  /** The Generate button: everybody anew. */
  generateAll(): void {
    const scene = this.editor.scene.peek();
    if (!scene) return;
    this.editor.motion.value = { ...this.editor.motion.peek(), stale: true };
    this.send(
      { agents: 'all', react: false, commit: { name: 'Everybody worked out anew', agent: null, undo: false } },
      false,
    );
  }

  private send(w: Wanted, preview: boolean): void {
    const { editor } = this;
    const scene = editor.scene.peek();
    if (!scene || editor.away.peek()) return;
    const before = editor.motion.peek();
    const conditions: Record<string, ConditionJson> = {};
    for (const a of scene.agents.values()) {
      const c = conditionOf(a);
      if (!isEmptyCondition(c) || this.library.hadConditions(a.id)) conditions[a.id] = c;
    }
    const inline =
      before.driving.size > 0 || (w.kept?.size ?? 0) > 0 || scene.others === 'still' || !this.library.stored;
    const part = (): string => (inline ? this.inlinePart(scene, before, w) : `"scene_id":${JSON.stringify(scene.id)}`);
    this.generator.ask({
      preview,
      scenePart: part,
      fullPart: async () => this.fullPart(scene, before, w),
      options: {
        agents: w.agents,
        react: w.react,
        conditions,
        seed: scene.seed,
        diversity: scene.diversity,
        steps: STEPS,
        stream_modes: 'all',
        score: w.commit !== null && !w.unscored,
        ...rollout(scene),
      },
      on: this.handlers(scene, w),
    });
    if (!preview) editor.status.value = { kind: 'refining', step: 0, steps: STEPS, ms: 0 };
  }

  private inlinePart(scene: Scene, set: MotionSet, w: Wanted): string {
    const hit = this.partCache;
    // A drag asks sixty times a second about the same surroundings; they are written once.
    if (!w.commit && hit && hit.set === set && hit.others === scene.others) return hit.text;
    const text = `"scene":${JSON.stringify(this.sceneJson(scene, set, w, this.library.mapRef ? { ref: this.library.mapRef } : this.library.mapJson!))}`;
    if (!w.commit) this.partCache = { set, others: scene.others, text };
    return text;
  }

  private fullPart(scene: Scene, set: MotionSet, w: Wanted): string {
    return `"scene":${JSON.stringify(this.sceneJson(scene, set, w, this.library.mapJson!))}`;
  }

  private sceneJson(scene: Scene, set: MotionSet, w: Wanted, map: SceneJson['map']): SceneJson {
    const raw = this.library.raw!;
    const kept = [...set.futures].filter(([id]) => set.driving.has(id) || w.kept?.has(id));
    const moving = new Set(this.editor.touchedIds(scene));
    return {
      ...raw,
      map,
      agents: scene.others === 'still' ? stillAgents(raw, scene, moving) : raw.agents,
      generated: generatedJson(scene, kept),
    };
  }

  private handlers(scene: Scene, w: Wanted): Handlers {
    const { editor } = this;
    const subject = w.commit ? (w.commit.agent ?? editor.selection.peek()) : (w.agents as string[])[0];
    let began = false;
    let slow = false;
    // Letters stay with their ideas during a drag and from the first guess to the answer, and a pick keeps its letter.
    const keep = (a: Agent): KeepOrder => {
      const d = editor.draft.peek();
      const like = d?.id === a.id && !d.futures.sketch ? d.futures : editor.motion.peek().futures.get(a.id);
      return { like, always: editor.drag.peek() !== null || a.chosen !== null || (began && a.id === subject) };
    };
    return {
      draft: (e, step, steps, ms) => {
        this.answered();
        const id = subject && e.agents[subject] ? subject : null;
        batch(() => {
          // Later windows go on from where the first one led; its six stay on screen until all is worked out.
          if (e.window) {
            editor.status.value = { kind: 'refining', step, steps, ms, part: partOf(scene, e.window) };
            return;
          }
          if (id && editor.selection.peek() === id) began = this.draw(id, e, step, steps, keep) || began;
          editor.status.value = { kind: 'refining', step, steps, ms };
        });
      },
      final: (e, ms) => {
        this.answered();
        if (w.commit) this.finalOfCommit(scene, e, w, ms, keep);
        else this.finalOfPreview(scene, e, w, ms, keep);
      },
      refused: (p) => {
        // Futures matter more than their score: when working out both fails, they are asked for alone.
        if (p.code === 'internal' && w.commit && !w.unscored) this.send({ ...w, unscored: true }, false);
        else this.refused(p);
      },
      slow: (ms) => {
        editor.status.value = { kind: 'slow', ms };
        if (!slow) editor.say('This takes longer than usual.');
        slow = true;
      },
      away: () => this.wentAway(w),
    };
  }

  private draw(id: string, e: DraftEvent, step: number, steps: number, keep: Keep): boolean {
    const { editor } = this;
    const a = editor.scene.peek()?.agents.get(id);
    const start = a && startPose(a);
    if (!a || !start) return false;
    const shown = editor.draft.peek();
    // The answer to a release starts rough again; what the drag has settled already stays until it is better.
    if (!editor.drag.peek() && shown?.id === id && !shown.futures.sketch && step < shown.futures.step) return false;
    const f = readFutures(e.agents[id], start, step, steps, a.type === 'pedestrian', keep(a));
    const old = editor.draft.peek();
    const earlier =
      step > 0 && !this.calm.matches && old?.id === id && !old.futures.sketch
        ? [old.futures, ...old.earlier].slice(0, 3)
        : [];
    editor.draft.value = { id, futures: f, earlier };
    return true;
  }

  private finalOfPreview(scene: Scene, e: FinalEvent, w: Wanted, ms: number, keep: Keep): void {
    const { editor } = this;
    const id = (w.agents as string[])[0];
    const f = this.readAll(scene, e, keep).get(id);
    if (!f) return;
    const reach = readReach(e.resolved?.[id]);
    batch(() => {
      editor.status.value = { kind: 'settled', ms, adapted: null };
      if (reach) editor.liveReach.value = { id, reach };
      if (editor.drag.peek() || editor.motion.peek().stale) {
        if (editor.selection.peek() === id) editor.draft.value = { id, futures: f, earlier: [] };
        return;
      }
      // A look at six futures: kept beside the others, nobody follows them yet.
      const m = editor.motion.peek();
      editor.motion.value = {
        ...m,
        futures: new Map(m.futures).set(id, f),
        reach: reach ? new Map(m.reach).set(id, reach) : m.reach,
      };
      editor.cache.put(editor.motion.peek());
      if (editor.draft.peek()?.id === id) editor.draft.value = null;
    });
    const best = f.modes[f.chosen];
    if (best && !editor.drag.peek())
      editor.say(`Six futures. Most likely: ${best.name}, ${Math.round(best.probability * 100)} percent.`);
  }

  private finalOfCommit(scene: Scene, e: FinalEvent, w: Wanted, ms: number, keep: Keep): void {
    const { editor } = this;
    if (sceneKey(editor.scene.peek()!) !== sceneKey(scene)) return;
    const before = editor.motion.peek();
    const answers = this.readAll(scene, e, keep);
    // A look at somebody's futures from before the change is no longer true.
    const futures = new Map(
      [...before.futures].filter(([id]) => before.driving.has(id) || w.kept?.has(id) || touched(scene.agents.get(id)!)),
    );
    for (const [id, f] of answers) futures.set(id, f);
    const all = w.agents === 'all';
    const driving =
      scene.others === 'react' || all ? new Set([...before.driving, ...answers.keys()]) : new Set<string>();
    for (const id of editor.touchedIds(scene)) if (futures.has(id)) driving.add(id);
    const reach = new Map(before.reach);
    for (const [id, r] of Object.entries(e.resolved ?? {})) {
      const v = readReach(r);
      if (v) reach.set(id, v);
      else reach.delete(id);
    }
    const set: MotionSet = {
      key: sceneKey(scene),
      futures,
      driving,
      score: readScore(e.scores),
      reach,
      stale: false,
      head: e.generated,
      warnings: readWarnings(e),
    };
    editor.liveReach.value = null;
    // Those that were asked something are no others, also when only the mode of the others was changed.
    const subjects = w.commit!.agent ? [w.commit!.agent] : editor.touchedIds(scene);
    editor.settle(set, {
      except: new Set([...subjects, ...(editor.selection.peek() ? [editor.selection.peek()!] : [])]),
    });
    this.afterCommit(w.commit!, ms);
    const looked = editor.selection.peek();
    if (looked && !futures.has(looked)) this.selected(looked);
    if (!set.score) void this.rescore(w.commit, true);
  }

  private afterCommit(step: { name: string; agent: string | null; undo: boolean }, ms: number): void {
    const { editor } = this;
    const n = editor.changes.peek().length;
    editor.status.value = { kind: 'settled', ms, adapted: step.agent ? n : null };
    if (step.undo) return;
    const scene = editor.scene.peek()!;
    const tail = !step.agent
      ? ''
      : scene.others !== 'react'
        ? ''
        : n === 0
          ? ' Nobody else had to change.'
          : n === 1
            ? ' 1 other changed.'
            : ` ${n} others changed.`;
    editor.notify({ text: `${step.name}.${tail}`, undo: true });
    const first = editor.changes.peek()[0];
    editor.say(`${step.name}.${tail}${first ? ` ${first.name} ${first.words}.` : ''}`);
    const hit = editor.events.peek().find((v) => v.kind === 'collision');
    if (hit) editor.say(`Collision, ${hit.a.name} and ${hit.b.name}, ${hit.time.toFixed(1)} seconds.`, true);
  }

  private readAll(scene: Scene, e: FinalEvent, keep: Keep): Map<string, Futures> {
    const out = new Map<string, Futures>();
    for (const [id, json] of Object.entries(e.samples[0]?.agents ?? {})) {
      const a = scene.agents.get(id),
        start = a && firstPose(a, json);
      if (!a || !start || !json.modes?.length) continue;
      const known = this.editor.motion.peek().futures.get(id);
      // A picked future comes back longer than it was; the other five stand as they are.
      const longer = known && a.chosen !== null && json.modes.length === 1 && known.modes[a.chosen];
      out.set(
        id,
        longer
          ? {
              ...known,
              modes: known.modes.map((m) => (m === longer ? { ...m, motion: motionFrom(json.modes[0], start) } : m)),
            }
          : readFutures(json, start, STEPS, STEPS, a.type === 'pedestrian', keep(a)),
      );
    }
    return out;
  }

  /** Events for motions that are known already: after a pick among futures, and for the log at the start. */
  async rescore(step: Wanted['commit'] = null, quiet = false): Promise<void> {
    const { editor } = this;
    const scene = editor.scene.peek();
    if (!scene || !this.library.raw) return;
    const set = editor.motion.peek();
    this.scoreAbort?.abort();
    const abort = (this.scoreAbort = new AbortController());
    const trajectories: Record<string, unknown> = {};
    const driving = new Set(set.driving);
    for (const id of editor.touchedIds(scene)) if (set.futures.has(id)) driving.add(id);
    const shown: MotionSet = { ...set, key: sceneKey(scene), driving, stale: false, fresh: null };
    for (const a of scene.agents.values())
      if (driving.has(a.id) || (scene.others === 'still' && canChange(a)))
        trajectories[a.id] = trackJson(motionOf(scene, shown, a));
    if (set.stale) editor.settle(shown, null);
    const ref = this.library.stored
      ? { scene_id: scene.id }
      : { scene: { ...this.library.raw, map: this.library.mapJson, generated: null } };
    try {
      const reply = await this.client.score(
        { ...ref, ...(Object.keys(trajectories).length ? { trajectories } : {}) },
        abort.signal,
      );
      if (editor.scene.peek() !== scene) return;
      const now = { ...editor.motion.peek(), score: readScore(reply) };
      editor.motion.value = now;
      editor.cache.put(now);
      if (step && !quiet) this.afterCommit(step, 0);
    } catch (e) {
      // Without a score there are no events to show; the motions stand.
      if (e instanceof Away && step) this.wentAway({ agents: [], react: false, commit: step });
    }
    if (step && !quiet && editor.status.peek().kind === 'refining') editor.status.value = { kind: 'ready' };
  }

  private refused(p: Problem): void {
    const first = p.errors?.[0];
    const words =
      first?.detail ??
      (first?.min !== undefined ? `A value is outside ${first.min} to ${first.max}.` : (p.detail ?? p.title));
    this.editor.status.value = { kind: 'refused', words };
    this.editor.say(words);
  }

  private sketch(id: string): void {
    const scene = this.editor.scene.peek(),
      a = scene?.agents.get(id);
    const f = scene && a ? sketchFutures(scene, a) : null;
    if (f && this.editor.selection.peek() === id) this.editor.draft.value = { id, futures: f, earlier: [] };
  }

  private wentAway(w: Wanted): void {
    const { editor } = this;
    if (w.commit) this.missed = Math.max(1, this.missed + 1);
    if (!editor.away.peek()) {
      this.tries = 0;
      editor.say('Generator away. Nothing is lost.', true);
    }
    editor.status.value = { kind: 'away' };
    const id = w.commit?.agent ?? (Array.isArray(w.agents) ? w.agents[0] : null);
    if (id) this.sketch(id);
    this.countDown();
  }

  private countDown(): void {
    const { editor } = this;
    clearInterval(this.retryTimer);
    let left = RETRY_S[Math.min(this.tries, RETRY_S.length - 1)];
    this.tries++;
    editor.away.value = { retryIn: left, waiting: this.missed };
    this.retryTimer = setInterval(() => {
      left--;
      if (left > 0) editor.away.value = { retryIn: left, waiting: this.missed };
      else void this.tryNow();
    }, 1000) as unknown as number;
  }

  async tryNow(): Promise<void> {
    clearInterval(this.retryTimer);
    if (!(await this.client.answers())) return this.countDown();
    this.back();
  }

  private back(): void {
    const { editor } = this;
    const n = this.missed;
    this.missed = 0;
    clearInterval(this.retryTimer);
    editor.away.value = null;
    editor.draft.value = null;
    this.library.retry();
    editor.notify({
      text: n ? `The generator is back. ${n} change${n > 1 ? 's' : ''} worked out.` : 'The generator is back.',
    });
    if (editor.motion.peek().stale)
      this.workOut({ name: 'Waiting changes', agent: editor.selection.peek(), undo: true });
    else this.selected(editor.selection.peek());
  }

  private answered(): void {
    if (this.editor.away.peek()) this.back();
  }

  /** One line for the status chip when nothing is going on. */
  eventLine(): string {
    const s = this.editor.scene.peek();
    return s ? summary(readEvents(s, this.editor.motion.peek())) : '';
  }
}
