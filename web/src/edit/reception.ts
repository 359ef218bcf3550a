// What becomes of the generator's answers: drafts on their way, the futures of a look, the motion after a change.
import { batch, effect } from '@preact/signals-core';
import type { AgentFuturesJson } from '../model/document/scene-json';
import {
  ideas,
  isBlocked,
  keepVerdicts,
  percents,
  withOwnFirst,
  type Futures,
  type KeepOrder,
  type Reach,
} from '../model/document/futures';
import type { Fault } from '../model/document/future-facts';
import { goesOneWay } from '../model/document/reaction-records';
import { readFutures, withNames } from '../model/words/named-futures';
import { findChanges } from '../model/words/change-words';
import { nameIn, sceneKey, startPose, type Agent, type Scene } from '../model/document/scene';
import { whyAnother, whyNot } from '../model/words/verdict-words';
import type { Handlers } from '../net/generator';
import { inWords } from '../net/refusal';
import type { DraftEvent, FinalEvent, Problem } from '../net/types';
import type { Step } from './document/step';
import type { Editor } from './editor';
import { FrozenNames } from './frozen-names';
import { futuresOf, motionAfter, naming, type Keep } from './motion-after';
import type { Wanted } from './question';
import { Steady } from './steady';
import { readReach } from './read-answer';
import { outcome, spokenCollision, spokenOutcome, spokenVerdict } from './report';
import { Rest } from './rest';
import { figure } from '../model/base/units';
import { TEXTS } from '../texts/editing/generation';
import { LANGUAGE } from '../texts/language';

/** What an answer may set off; the generation does it. */
export interface Hooks {
  answered(): void;
  away(w: Wanted): void;
  askAgain(w: Wanted): void;
  look(id: string): void;
  score(step: Step): void;
  /** What everybody does in the document on screen is known. */
  known(): void;
}

/** Refinement steps left behind on screen as trails. */
const TRAILS = 3;

/** Futures that stand for so long in a drag are named anew. */
const RESTS_MS = 450;

export class Reception {
  readonly #calm =
    typeof matchMedia === 'undefined' ? { matches: false } : matchMedia('(prefers-reduced-motion: reduce)');
  readonly #names = new FrozenNames();

  readonly #steady: Steady;
  readonly #rest = new Rest(RESTS_MS);
  /** The document of the last answer foreseen, and what was bold before it took the place of the drag's own. */
  #foreseen: { readonly key: string; readonly bold: string | null } | null = null;
  /** The road user whose speed curve is off since a change that was answered during a drag. */
  #curveOff: string | null = null;

  constructor(
    private readonly editor: Editor,
    private readonly hooks: Hooks,
  ) {
    this.#steady = new Steady((changes) => editor.answers.foresee(changes));
    // What was said of a drag ends with it.
    effect(() => {
      if (editor.foreseen.value !== null) return;
      this.#steady.forget();
      this.#foreseen = null;
    });
  }

  /** Handlers for the answer to one question. */
  of(scene: Scene, w: Wanted): Handlers {
    const { editor, hooks } = this;
    const subject = w.step ? (w.step.agent ?? editor.selection.peek()) : w.agents[0];
    let began = false;
    let slow = false;
    const bold = w.step && subject ? this.#boldOf(subject) : null;
    const keep: Keep = (a) => this.#lettersOf(a, (began || w.step !== null) && a.id === subject);
    const atRest: Keep = (a) => this.#lettersAtRest(a);
    return {
      draft: (e, step, steps, ms) => {
        hooks.answered();
        began = this.#draft(scene, e, { step, steps, ms, subject, keep }) || began;
      },
      final: (e, ms) => {
        hooks.answered();
        if (w.step) {
          this.#finalOfChange(scene, e, w, w.step, ms, atRest);
          this.#sayWhyAnother(scene, subject, bold);
        } else this.#finalOfLook(scene, e, w.agents[0], ms, editor.dragging.peek() ? keep : atRest);
      },
      refused: (p) => {
        // Futures matter more than their score: when working out both fails, they are asked for alone.
        if (p.code === 'internal' && w.step && !w.unscored) hooks.askAgain({ ...w, unscored: true });
        else this.#refused(p);
      },
      slow: (ms) => {
        editor.answers.report({ kind: 'slow', ms });
        if (!slow) editor.notices.say(TEXTS.thisTakesLonger);
        slow = true;
      },
      away: () => {
        editor.answers.foresee(null);
        hooks.away(w);
      },
    };
  }

  /** Letters stay with their ideas during a drag and from first guess to answer, and a pick keeps its letter. */
  #lettersOf(a: Agent, began: boolean): KeepOrder {
    const { editor } = this;
    const d = editor.draft.peek();
    const like = d?.id === a.id && !d.futures.sketch ? d.futures : editor.motion.peek().futures.get(a.id);
    return { like, always: editor.dragging.peek() || a.chosen !== null || began };
  }

  /** At rest A is the likeliest; only where somebody picked a letter do they stay. */
  #lettersAtRest(a: Agent): KeepOrder {
    return a.chosen === null ? 'rank' : this.#lettersOf(a, true);
  }

  /** Which idea is bold as the hand lets go; null where no drag left one. */
  #boldOf(id: string): string | null {
    const { editor } = this;
    const d = editor.draft.peek();
    const a = editor.scene.peek()?.agents.get(id);
    if (d?.id !== id || d.futures.sketch || !a || a.chosen !== null) return null;
    return ideas(d.futures.modes)[d.futures.chosen];
  }

  /** The bold one is another than in the drag, or not the likeliest: one sentence says why. */
  #sayWhyAnother(scene: Scene, id: string | null, bold: string | null): void {
    const { editor } = this;
    const f = id !== null && editor.motion.peek().futures.get(id);
    if (!f || editor.motion.peek().stale || scene.agents.get(id)!.chosen !== null) return;
    const was = bold === null ? 0 : ideas(f.modes).indexOf(bold);
    const why = (bold === null ? whyNot : whyAnother)(f, was, f.chosen, nameIn(scene));
    editor.answers.explain(why === null ? null : { id, words: `${why}.` });
    if (why) editor.notices.say(`${why}.`);
  }

  // -------------------------------------------------------------- drafts

  /** True when something of it was drawn. */
  #draft(
    scene: Scene,
    e: DraftEvent,
    at: { step: number; steps: number; ms: number; subject: string | null; keep: Keep },
  ): boolean {
    const { editor } = this;
    const { step, steps, ms, subject } = at;
    return batch(() => {
      // Later windows go on from where the first one led; its six stay on screen until all is worked out.
      if (e.window) {
        editor.answers.report({ kind: 'refining', step, steps, ms, part: secondsOf(scene, e.window) });
        return false;
      }
      const id = subject && e.agents[subject] && editor.selection.peek() === subject ? subject : null;
      const drawn = id !== null && !this.#knownBetter(scene) && this.#draw(id, e.agents[id], step, steps, at.keep);
      editor.answers.report({ kind: 'refining', step, steps, ms });
      return drawn;
    });
  }

  #draw(id: string, json: AgentFuturesJson, step: number, steps: number, keep: Keep): boolean {
    const { editor } = this;
    const a = editor.scene.peek()?.agents.get(id);
    const start = a && startPose(a);
    if (!a || !start) return false;
    const shown = editor.draft.peek();
    const last = shown?.id === id && !shown.futures.sketch ? shown : null;
    // The answer to a release starts rough again; what the drag has settled already stays until it is better.
    if (last && !editor.dragging.peek() && step < last.futures.step) return false;
    const sent = readFutures(json, start, step, steps, a.type === 'pedestrian', keep(a));
    const read = keepVerdicts(last?.futures ?? null, sent);
    const f = this.#withFrozenNames(a, editor.dragging.peek() ? this.#withoutThoseWhoAnswer(read) : read);
    const trails = last && step > 0 && !this.#calm.matches ? [last.futures, ...last.earlier].slice(0, TRAILS) : [];
    this.#show(a, f, trails);
    return true;
  }

  /** Draws futures. Where the hand of a drag rests at them they get the names that they have at rest. */
  #show(a: Agent, f: Futures, trails: readonly Futures[] = []): void {
    const { editor } = this;
    this.#rest.stop();
    editor.answers.showDraft(a.id, f, trails);
    if (!editor.dragging.peek()) return;
    this.#rest.begin(() => {
      const d = editor.draft.peek();
      if (!editor.dragging.peek() || d?.futures !== f) return;
      this.#names.rest();
      editor.answers.showDraft(a.id, withNames(f, naming(editor.scene.peek()!, a)), d.earlier);
    });
  }

  /** What is on screen keeps its names as far as they hold. */
  #withFrozenNames(a: Agent, read: Futures): Futures {
    const { editor } = this;
    const d = editor.draft.peek();
    const before = d?.id === a.id && !d.futures.sketch ? d.futures : editor.motion.peek().futures.get(a.id);
    const who = naming(editor.scene.peek()!, a);
    return before ? this.#names.keep(before, read, who, performance.now()) : withNames(read, who);
  }

  // -------------------------------------------------------------- what the others would do

  /** What a release would be answered, while the hand still moves. */
  foresee(scene: Scene, e: FinalEvent, w: Wanted): void {
    const { editor } = this;
    if (!editor.dragging.peek()) return;
    this.hooks.answered();
    const set = motionAfter(editor.motion.peek(), scene, e, w, (a) => this.#lettersOf(a, true));
    const subjects = this.#subjects(scene, w.step);
    this.#steady.hear(findChanges(scene, editor.motion.peek(), set, subjects, editor.speedUnit.peek()));
    const key = sceneKey(scene);
    const id = w.step?.agent;
    const f = id && set.futures.get(id);
    if (!f || editor.selection.peek() !== id || sceneKey(editor.scene.peek()!) !== key) return;
    // The hand rests here: its six are those that the others answer, judged with what these do.
    this.#foreseen = { key, bold: this.#boldOf(id) };
    const reach = readReach(e.resolved[id]);
    if (reach) editor.answers.judge(id, reach);
    const a = scene.agents.get(id)!;
    this.#show(a, this.#withFrozenNames(a, f));
  }

  /** Whether somebody stays in the way is known when they have answered, as is all about a goal that they have. */
  #isForOthersToSay(scene: Scene, reach: Reach): boolean {
    if (!this.editor.dragging.peek()) return false;
    return this.#knownBetter(scene) || (scene.others === 'react' && isBlocked(reach));
  }

  /** Is what a drag's own question says of this document known better? */
  #knownBetter(scene: Scene): boolean {
    return this.#foreseen !== null && this.editor.dragging.peek() && this.#foreseen.key === sceneKey(scene);
  }

  /** While the hand moves nobody is told to be hit who would give way. */
  #withoutThoseWhoAnswer(f: Futures): Futures {
    const answering = new Set(this.editor.foreseen.peek()?.map((c) => c.id));
    const met = (x: Fault): boolean => x.with !== null && answering.has(x.with);
    if (!answering.size || !f.modes.some((m) => m.about?.faults.some(met))) return f;
    return {
      ...f,
      modes: f.modes.map((m) =>
        m.about ? { ...m, about: { ...m.about, faults: m.about.faults.filter((x) => !met(x)) } } : m,
      ),
    };
  }

  /** The release is answered by what was foreseen of it. */
  takeOver(scene: Scene, e: FinalEvent, w: Wanted, step: Step, ms: number): void {
    this.hooks.answered();
    const own = this.#foreseen?.key === sceneKey(scene) ? this.#foreseen.bold : null;
    const bold = own ?? (step.agent ? this.#boldOf(step.agent) : null);
    this.#finalOfChange(scene, e, w, step, ms, (a) => this.#lettersAtRest(a));
    this.#sayWhyAnother(scene, step.agent, bold);
  }

  /** Those that were asked something are no others, also when only the mode of the others was changed. */
  #subjects(scene: Scene, step: Step | null): Set<string> {
    const { editor } = this;
    const subjects = new Set(step?.agent ? [step.agent] : (step?.several ?? editor.touchedIds(scene)));
    const selected = editor.selection.peek();
    if (selected) subjects.add(selected);
    return subjects;
  }

  // -------------------------------------------------------------- final answers

  #finalOfLook(scene: Scene, e: FinalEvent, id: string, ms: number, keep: Keep): void {
    const { editor } = this;
    const known = editor.motion.peek();
    const answer = futuresOf(known, scene, e, keep).get(id);
    if (!answer) return;
    const reach = readReach(e.resolved[id]);
    const dragging = editor.dragging.peek();
    const a = scene.agents.get(id)!;
    const [way] = !dragging && goesOneWay(known, a) ? known.futures.get(id)!.modes : [];
    const settled = way ? withNames(withOwnFirst(way, answer), naming(scene, a)) : answer;
    const f = dragging ? this.#withFrozenNames(scene.agents.get(id)!, this.#withoutThoseWhoAnswer(settled)) : settled;
    batch(() => {
      editor.answers.report({ kind: 'settled', ms, adapted: null });
      if (reach && !this.#isForOthersToSay(scene, reach)) editor.answers.judge(id, reach);
      if (!dragging && !editor.motion.peek().stale) editor.answers.look(id, f, reach);
      else if (editor.selection.peek() === id && !this.#knownBetter(scene)) this.#show(scene.agents.get(id)!, f);
    });
    const best = f.modes[f.chosen];
    if (!best || dragging) return;
    this.#names.rest();
    const likely = percents(f.modes)[f.chosen];
    editor.notices.say(TEXTS.sixFuturesMost(best.name, likely));
  }

  #finalOfChange(scene: Scene, e: FinalEvent, w: Wanted, step: Step, ms: number, keep: Keep): void {
    const { editor, hooks } = this;
    if (sceneKey(editor.scene.peek()!) !== sceneKey(scene)) return;
    const set = motionAfter(editor.motion.peek(), scene, e, w, keep);
    const selected = editor.selection.peek();
    this.#names.rest();
    editor.answers.dropLiveReach();
    editor.answers.settle(scene, set, this.#subjects(scene, step), editor.speedUnit.peek());
    hooks.known();
    this.settled(step, ms);
    if (selected && (!set.futures.has(selected) || goesOneWay(set, scene.agents.get(selected)!))) hooks.look(selected);
    if (!set.score) hooks.score(step);
  }

  /** A change is worked out: who changed, in the status line, a toast and a sentence. */
  settled(step: Step, ms: number): void {
    const { editor } = this;
    const changes = editor.changes.peek();
    editor.answers.report({ kind: 'settled', ms, adapted: step.agent || step.several ? changes.length : null });
    if (step.undo) return;
    const { agent } = step;
    const curve = step.curve ?? (agent !== null && agent === this.#curveOff ? 'open' : undefined);
    // Its own answer says what came of both.
    if (agent && curve === 'fits' && this.#takeUp(agent)) return;
    if (agent && curve) this.#curveOff = null;
    const scene = editor.scene.peek()!;
    const events = editor.events.peek();
    const keep =
      agent && curve ? { label: TEXTS.keepItsCurve, run: () => void editor.curve.takeUp(agent, false) } : null;
    editor.notices.show({
      text: `${outcome(step, scene, changes, events)}${keep ? ` ${TEXTS.itsCurveIsOff}` : ''}`,
      undo: true,
      ...(keep ? { action: keep } : {}),
    });
    const said = [spokenOutcome(step, scene, changes, events), spokenVerdict(editor, step)];
    editor.notices.say(said.filter(Boolean).join(' '));
    const collision = spokenCollision(events);
    if (collision) editor.notices.say(collision, true);
  }

  /**
   * Draws the speed curve of a change within its step. During a drag it waits for the end: a drag that is put back
   * leaves the step as it is, and after a drag that is not, the curve is offered with the answer to that.
   */
  #takeUp(agent: string): boolean {
    const { curve, document } = this.editor;
    if (!document.trial.peek()) return curve.takeUp(agent, true);
    const at = document.committed.peek();
    this.#curveOff = agent;
    document.afterTrial(() => {
      if (document.committed.peek() !== at) return;
      this.#curveOff = null;
      curve.takeUp(agent, true);
    });
    return true;
  }

  #refused(p: Problem): void {
    const first = p.errors?.[0];
    const range =
      first?.min !== undefined && first.max !== undefined
        ? TEXTS.aValueIsOutside(figure(first.min), figure(first.max))
        : null;
    // The server says more, but in English.
    const words = LANGUAGE !== 'en' && range ? range : inWords(p);
    this.editor.answers.foresee(null);
    this.editor.answers.report({ kind: 'refused', words });
    this.editor.notices.say(words);
  }
}

/** Which seconds a later window is about. */
const secondsOf = (s: Scene, window: number): string =>
  TEXTS.toS(window * s.replan, Math.min(s.length, (window + 1) * s.replan));
