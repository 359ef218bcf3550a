// Handles the generator's answers: streamed drafts, the futures of a selected road user, the motion after a change.
import { batch, effect } from '@preact/signals-core';
import type { AgentFuturesJson } from '../../model/document/scene-json';
import {
  ideas,
  isBlocked,
  keepVerdicts,
  rankOf,
  withOwnFirst,
  type Futures,
  type KeepOrder,
  type Reach,
} from '../../model/document/futures';
import type { Fault } from '../../model/document/future-facts';
import { goesOneWay } from '../../model/document/reaction-records';
import { naming, readFutures, withNames } from '../../model/words/named-futures';
import { findChanges } from '../../model/words/change-words';
import { nameIn, sceneKey, startPose, touchedIn, type Agent, type Scene } from '../../model/document/scene';
import { whyAnother, whyNotLikeliest } from '../../model/words/why-shown';
import type { Handlers } from '../../net/generator';
import { inWords } from '../../net/refusal';
import type { DraftEvent, FinalEvent, Problem } from '../../net/types';
import type { Step } from '../document/step';
import type { Editor } from '../session/editor';
import { FrozenNames } from './frozen-names';
import { futuresOf, motionAfter, type Keep } from './merge-answer';
import type { Wanted } from './request-builder';
import { StableWords } from './stable-words';
import { readReach } from './read-answer';
import { outcome, spokenCollision, spokenOutcome, spokenVerdict } from './outcome-words';
import { RestTimer } from './rest-timer';
import { figure } from '../../model/base/units';
import { TEXTS } from '../../texts/editing/generation';
import { LANGUAGE } from '../../texts/language';

/** Follow-up work of an answer, done by the generation. */
export interface Hooks {
  answered(): void;
  away(w: Wanted): void;
  askAgain(w: Wanted): void;
  look(id: string): void;
  score(step: Step): void;
  /** Draws again the speeds of a curve that a change has put out of force; false where it cannot. */
  takeUpCurve(id: string, joins: boolean): boolean;
  /** The motions of all road users in the shown document are known. */
  known(): void;
}

/** Refinement steps left behind on screen as trails. */
const TRAILS = 3;

/** Futures are renamed once they have been unchanged for this long in a drag. */
const RESTS_MS = 450;

export class AnswerHandler {
  readonly #reducedMotion =
    typeof matchMedia === 'undefined' ? { matches: false } : matchMedia('(prefers-reduced-motion: reduce)');
  readonly #names = new FrozenNames();

  readonly #stable: StableWords;
  readonly #rest = new RestTimer(RESTS_MS);
  /** The document of the last previewed answer, and the bold future before that answer replaced the drag's own. */
  #previewed: { readonly key: string; readonly bold: string | null } | null = null;
  /** The road user whose speed curve was put out of force by a change answered during a drag. */
  #curveOff: string | null = null;

  constructor(
    private readonly editor: Editor,
    private readonly hooks: Hooks,
  ) {
    this.#stable = new StableWords((changes) => editor.answers.preview(changes));
    // The state of a preview ends with its drag.
    effect(() => {
      if (editor.answers.previewed.value !== null) return;
      this.#stable.forget();
      this.#previewed = null;
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
        } else this.#finalOfLook(scene, e, w.agents[0], ms, editor.drag.active.peek() ? keep : atRest);
      },
      refused: (p) => {
        // Futures matter more than their score: when both together fail, the futures are requested without the score.
        if (p.code === 'internal' && w.step && !w.unscored) hooks.askAgain({ ...w, unscored: true });
        else this.#refused(p);
      },
      slow: (ms) => {
        editor.answers.report({ kind: 'slow', ms });
        if (!slow) editor.notices.say(TEXTS.thisTakesLonger);
        slow = true;
      },
      away: () => {
        editor.answers.preview(null);
        hooks.away(w);
      },
    };
  }

  /**
   * Letters stay with their ideas during a drag and from the first draft to the answer; a picked future keeps its
   * letter.
   */
  #lettersOf(a: Agent, began: boolean): KeepOrder {
    const { editor } = this;
    const d = editor.answers.draft.peek();
    const like = d?.id === a.id && !d.futures.sketch ? d.futures : editor.answers.motion.peek().futures.get(a.id);
    return { like, always: editor.drag.active.peek() || a.chosen !== null || began };
  }

  /** At rest A is the likeliest; letters stay fixed only after a pick. */
  #lettersAtRest(a: Agent): KeepOrder {
    return a.chosen === null ? 'rank' : this.#lettersOf(a, true);
  }

  /** The future that is bold when the drag ends; null where no drag left one. */
  #boldOf(id: string): string | null {
    const { editor } = this;
    const d = editor.answers.draft.peek();
    const a = editor.scene.peek()?.agents.get(id);
    if (d?.id !== id || d.futures.sketch || !a || a.chosen !== null) return null;
    return ideas(d.futures.modes)[d.futures.chosen];
  }

  /** If the bold future differs from the drag's, or is not the likeliest, one sentence gives the reason. */
  #sayWhyAnother(scene: Scene, id: string | null, bold: string | null): void {
    const { editor } = this;
    const f = id !== null && editor.answers.motion.peek().futures.get(id);
    if (!f || editor.answers.motion.peek().stale || scene.agents.get(id)!.chosen !== null) return;
    const nameOf = nameIn(scene);
    const moved = bold !== null && whyAnother(f, ideas(f.modes).indexOf(bold), f.chosen, nameOf);
    const why = moved || whyNotLikeliest(f, f.chosen, nameOf);
    editor.answers.explain(why === null ? null : { id, words: `${why}.` });
    if (why) editor.notices.say(`${why}.`);
  }

  // -------------------------------------------------------------- drafts

  /** True when a part of it was drawn. */
  #draft(
    scene: Scene,
    e: DraftEvent,
    at: { step: number; steps: number; ms: number; subject: string | null; keep: Keep },
  ): boolean {
    const { editor } = this;
    const { step, steps, ms, subject } = at;
    return batch(() => {
      // Later windows continue from where the first one led; its six futures stay on screen until the last window is
      // done.
      if (e.window) {
        editor.answers.report({ kind: 'refining', step, steps, ms, part: secondsOf(scene, e.window) });
        return false;
      }
      const id = subject && e.agents[subject] && editor.selection.peek() === subject ? subject : null;
      const drawn = id !== null && !this.#knownBetter && this.#draw(id, e.agents[id], step, steps, at.keep);
      editor.answers.report({ kind: 'refining', step, steps, ms });
      return drawn;
    });
  }

  #draw(id: string, json: AgentFuturesJson, step: number, steps: number, keep: Keep): boolean {
    const { editor } = this;
    const a = editor.scene.peek()?.agents.get(id);
    const start = a && startPose(a);
    if (!a || !start) return false;
    const shown = editor.answers.draft.peek();
    const last = shown?.id === id && !shown.futures.sketch ? shown : null;
    // The answer to a release starts from rough drafts; the refined futures of the drag stay until a better step
    // arrives.
    if (last && !editor.drag.active.peek() && step < last.futures.step) return false;
    const sent = readFutures(json, start, step, steps, a.type === 'pedestrian', keep(a));
    const read = keepVerdicts(last?.futures ?? null, sent);
    const f = this.#withFrozenNames(a, editor.drag.active.peek() ? this.#withoutThoseWhoAnswer(read) : read);
    const trails =
      last && step > 0 && !this.#reducedMotion.matches ? [last.futures, ...last.earlier].slice(0, TRAILS) : [];
    this.#show(a, f, trails);
    return true;
  }

  /** Draws futures. Once the drag pauses on them they get the names that they have at rest. */
  #show(a: Agent, f: Futures, trails: readonly Futures[] = []): void {
    const { editor } = this;
    this.#rest.stop();
    editor.answers.showDraft(a.id, f, trails);
    if (!editor.drag.active.peek()) return;
    this.#rest.begin(() => {
      const d = editor.answers.draft.peek();
      if (!editor.drag.active.peek() || d?.futures !== f) return;
      this.#names.rest();
      editor.answers.showDraft(a.id, withNames(f, naming(editor.scene.peek()!, a)), d.earlier);
    });
  }

  /** The futures on screen keep their names while these still hold. */
  #withFrozenNames(a: Agent, read: Futures): Futures {
    const { editor } = this;
    const d = editor.answers.draft.peek();
    const before = d?.id === a.id && !d.futures.sketch ? d.futures : editor.answers.motion.peek().futures.get(a.id);
    const who = naming(editor.scene.peek()!, a);
    return before ? this.#names.keep(before, read, who, performance.now()) : withNames(read, who);
  }

  // -------------------------------------------------------------- reactions of the others

  /** Previews the answer to a release during the drag. */
  preview(scene: Scene, e: FinalEvent, w: Wanted): void {
    const { editor } = this;
    if (!editor.drag.active.peek()) return;
    this.hooks.answered();
    const set = motionAfter(editor.answers.motion.peek(), scene, e, w, (a) => this.#lettersOf(a, true));
    const subjects = this.#subjects(scene, w.step);
    this.#stable.hear(findChanges(scene, editor.answers.motion.peek(), set, subjects, editor.view.speedUnit.peek()));
    const key = sceneKey(scene);
    const id = w.step?.agent;
    const f = id && set.futures.get(id);
    if (!f || editor.selection.peek() !== id || sceneKey(editor.scene.peek()!) !== key) return;
    // The drag is still at this pose: the six futures judged with the others' reactions replace the drag's own.
    this.#previewed = { key, bold: this.#boldOf(id) };
    const reach = readReach(e.resolved[id]);
    if (reach) editor.answers.judge(id, reach);
    const a = scene.agents.get(id)!;
    this.#show(a, this.#withFrozenNames(a, f));
  }

  /**
   * The others' reactions decide whether the goal stays blocked, and replace the verdict of the drag's own question.
   */
  #isForOthersToSay(scene: Scene, reach: Reach): boolean {
    if (!this.editor.drag.active.peek()) return false;
    return this.#knownBetter || (scene.others === 'react' && isBlocked(reach));
  }

  /** Is a reaction preview of the shown document on screen? Answers of the drag's own questions are less exact. */
  get #knownBetter(): boolean {
    const scene = this.editor.scene.peek();
    return (
      this.#previewed !== null &&
      this.editor.drag.active.peek() &&
      scene !== null &&
      this.#previewed.key === sceneKey(scene)
    );
  }

  /** During a drag a collision with a road user that would give way is not shown. */
  #withoutThoseWhoAnswer(f: Futures): Futures {
    const answering = new Set(this.editor.answers.previewed.peek()?.map((c) => c.id));
    const met = (x: Fault): boolean => x.with !== null && answering.has(x.with);
    if (!answering.size || !f.modes.some((m) => m.about?.faults.some(met))) return f;
    return {
      ...f,
      modes: f.modes.map((m) =>
        m.about ? { ...m, about: { ...m.about, faults: m.about.faults.filter((x) => !met(x)) } } : m,
      ),
    };
  }

  /** The preview of exactly this document answers the release. */
  takeOver(scene: Scene, e: FinalEvent, w: Wanted, step: Step, ms: number): void {
    this.hooks.answered();
    const own = this.#previewed?.key === sceneKey(scene) ? this.#previewed.bold : null;
    const bold = own ?? (step.agent ? this.#boldOf(step.agent) : null);
    this.#finalOfChange(scene, e, w, step, ms, (a) => this.#lettersAtRest(a));
    this.#sayWhyAnother(scene, step.agent, bold);
  }

  /** Conditioned road users do not count as others, also when only the mode of the others was changed. */
  #subjects(scene: Scene, step: Step | null): Set<string> {
    const { editor } = this;
    const subjects = new Set(step?.agent ? [step.agent] : (step?.several ?? touchedIn(scene)));
    const selected = editor.selection.peek();
    if (selected) subjects.add(selected);
    return subjects;
  }

  // -------------------------------------------------------------- final answers

  #finalOfLook(scene: Scene, e: FinalEvent, id: string, ms: number, keep: Keep): void {
    const { editor } = this;
    const known = editor.answers.motion.peek();
    const answer = futuresOf(known, scene, e, keep).get(id);
    if (!answer) return;
    const reach = readReach(e.resolved[id]);
    const dragging = editor.drag.active.peek();
    const a = scene.agents.get(id)!;
    const [way] = !dragging && goesOneWay(known, a) ? known.futures.get(id)!.modes : [];
    const settled = way ? withNames(withOwnFirst(way, answer), naming(scene, a)) : answer;
    const f = dragging ? this.#withFrozenNames(scene.agents.get(id)!, this.#withoutThoseWhoAnswer(settled)) : settled;
    batch(() => {
      editor.answers.report({ kind: 'settled', ms, adapted: null });
      if (reach && !this.#isForOthersToSay(scene, reach)) editor.answers.judge(id, reach);
      if (!dragging && !editor.answers.motion.peek().stale) editor.answers.look(id, f, reach);
      else if (editor.selection.peek() === id && !this.#knownBetter) this.#show(scene.agents.get(id)!, f);
    });
    const best = f.modes[f.chosen];
    if (!best || dragging) return;
    this.#names.rest();
    editor.notices.say(TEXTS.sixFutures(best.name, rankOf(f.modes, f.chosen)));
  }

  #finalOfChange(scene: Scene, e: FinalEvent, w: Wanted, step: Step, ms: number, keep: Keep): void {
    const { editor, hooks } = this;
    if (sceneKey(editor.scene.peek()!) !== sceneKey(scene)) return;
    const set = motionAfter(editor.answers.motion.peek(), scene, e, w, keep);
    const selected = editor.selection.peek();
    this.#names.rest();
    editor.answers.dropLiveReach();
    editor.answers.settle(scene, set, this.#subjects(scene, step), editor.view.speedUnit.peek());
    hooks.known();
    this.settled(step, ms);
    if (selected && (!set.futures.has(selected) || goesOneWay(set, scene.agents.get(selected)!))) hooks.look(selected);
    if (!set.score) hooks.score(step);
  }

  /** A change is answered: status line, toast and spoken sentence report the affected road users. */
  settled(step: Step, ms: number): void {
    const { editor } = this;
    const changes = editor.answers.changes.peek();
    editor.answers.report({ kind: 'settled', ms, adapted: step.agent || step.several ? changes.length : null });
    if (step.undo) return;
    const { agent } = step;
    const curve = step.curve ?? (agent !== null && agent === this.#curveOff ? 'open' : undefined);
    // The answer to the redrawn curve reports both.
    if (agent && curve === 'fits' && this.#takeUp(agent)) return;
    if (agent && curve) this.#curveOff = null;
    const scene = editor.scene.peek()!;
    const events = editor.reading.events.peek();
    const keep =
      agent && curve ? { label: TEXTS.keepCurve, run: () => void this.hooks.takeUpCurve(agent, false) } : null;
    editor.notices.show({
      text: `${outcome(step, scene, changes, events)}${keep ? ` ${TEXTS.curveIsOff}` : ''}`,
      undo: true,
      ...(keep ? { action: keep } : {}),
    });
    const said = [spokenOutcome(step, scene, changes, events), spokenVerdict(editor, step)];
    editor.notices.say(said.filter(Boolean).join(' '));
    const collision = spokenCollision(events);
    if (collision) editor.notices.say(collision, true);
  }

  /**
   * Draws the speed curve of a change within its step. During a drag it waits for the end: a cancelled drag leaves the
   * step unchanged; after a committed one the curve is offered with the new answer.
   */
  #takeUp(agent: string): boolean {
    const { document } = this.editor;
    if (!document.trial.peek()) return this.hooks.takeUpCurve(agent, true);
    const at = document.committed.peek();
    this.#curveOff = agent;
    document.afterTrial(() => {
      if (document.committed.peek() !== at) return;
      this.#curveOff = null;
      this.hooks.takeUpCurve(agent, true);
    });
    return true;
  }

  #refused(p: Problem): void {
    const first = p.errors?.[0];
    const range =
      first?.min !== undefined && first.max !== undefined
        ? TEXTS.aValueIsOutside(figure(first.min), figure(first.max))
        : null;
    // The server's text has more detail, but is English only.
    const words = LANGUAGE !== 'en' && range ? range : inWords(p);
    this.editor.answers.preview(null);
    this.editor.answers.report({ kind: 'refused', words });
    this.editor.notices.say(words);
  }
}

/** The seconds of a later planning window. */
const secondsOf = (s: Scene, window: number): string =>
  TEXTS.toS(window * s.replan, Math.min(s.length, (window + 1) * s.replan));
