// Decides what to request from the generator and when: six futures of the selected road user, live ones during a drag,
// the motion of all after a change. `answer-handler.ts` handles the answers.
import { signal, type ReadonlySignal } from '@preact/signals-core';
import { DEFAULTS } from '../../model/base/domain';
import { goesOneWay, thoseWhoAnswer } from '../../model/document/reaction-records';
import { emptyMotion, type MotionSet } from '../../model/document/futures';
import { drawAnew } from '../../model/document/commands';
import { canChange, GOAL_TIME, sceneKey, touchedIn, type Scene } from '../../model/document/scene';
import { countedAnew } from '../../model/physics/verdict-updates';
import { Away } from '../../net/client';
import type { Generator, Handlers, Question } from '../../net/generator';
import { Connection } from './connection';
import { requestForChange, changedBy, whoReacts } from './request-for-change';
import { rejudged } from './merge-answer';
import { followed, scoreOf } from './scoring';
import type { Step } from '../document/step';
import type { Editor } from '../session/editor';
import type { SessionPart } from '../session/part';
import { ReactionPreview, type Known } from './reaction-preview';
import { RequestBuilder, type Wanted } from './request-builder';
import { AnswerHandler } from './answer-handler';
import type { Saving } from '../document/saving';
import type { SceneFile } from '../document/scene-file';
import { sketchFutures } from './sketch';
import { judgedCurves, withCurves } from './drawn-speeds';
import { TEXTS } from '../../texts/editing/generation';

/** Key repeats send one request, this long after the last one. */
const REST_MS = 80;

export class Generation implements SessionPart {
  readonly #requests: RequestBuilder;
  readonly #handler: AnswerHandler;
  readonly #connection: Connection;
  readonly #reactions: ReactionPreview;
  /** Counts the poses of drags. */
  #pose = 0;
  readonly #asking = signal(false);
  /** Requests without an answer yet, and a change that waits for the rest delay. */
  readonly #open = new Set<object>();
  #rest: ReturnType<typeof setTimeout> | undefined;
  #rested: () => void = () => undefined;
  #scoring: AbortController | null = null;

  /** Is a request open, or about to be sent? */
  readonly asking: ReadonlySignal<boolean> = this.#asking;

  constructor(
    private readonly editor: Editor,
    private readonly file: SceneFile,
    private readonly saving: Saving,
    private readonly generator: Generator,
    /** A connection of its own for the reactions of the others. */
    others: Generator,
    /** Draws again the speeds of a curve that a change has put out of force; false where it cannot. */
    takeUpCurve: (id: string, joins: boolean) => boolean,
  ) {
    this.#requests = new RequestBuilder(editor, file);
    this.#connection = new Connection(
      editor,
      () => generator.answers(),
      (waiting) => this.#back(waiting),
    );
    this.#handler = new AnswerHandler(editor, {
      answered: () => this.#connection.end(),
      away: (w) => this.#away(w),
      askAgain: (w) => this.#ask(w),
      look: (id) => this.#look(id),
      score: (step) => void this.score(step, true),
      known: () => this.#keep(),
      takeUpCurve,
    });
    this.#reactions = new ReactionPreview(others, {
      question: (scene, on) => this.#previewing(scene, on),
      preview: (scene, e) => {
        const asked = this.#onRelease(scene);
        if (asked) this.#handler.preview(scene, e, asked);
      },
      begin: () => this.#begin(),
    });
    editor.join(this);
  }

  // -------------------------------------------------------------- triggers

  /** A scene was opened without the answers to its changes. */
  begin(everybody: boolean): void {
    const scene = this.editor.scene.peek();
    const step = { name: TEXTS.sceneOpened, agent: null, undo: true, ...(everybody ? { everybody } : {}) };
    if (scene) this.committed(scene, step);
  }

  selected(id: string | null): void {
    if (id) {
      this.#look(id);
      return;
    }
    const { answers } = this.editor;
    // A running answer to a change must still arrive; only a request for the futures of a selection is dropped.
    if (answers.motion.peek().stale) return;
    this.generator.cancel();
    // The status about its futures ends with it.
    if (['refining', 'slow', 'settled'].includes(answers.status.peek().kind)) answers.report({ kind: 'ready' });
  }

  /** The six futures of one road user: none is followed yet, and no other road user moves. */
  #look(id: string): void {
    const { editor } = this;
    const a = editor.agent.peek();
    const m = editor.answers.motion.peek();
    const only = a !== null && goesOneWay(m, a);
    if (a && canChange(a) && this.#connection.now && !only) this.#sketch(id, true);
    if (!a || !canChange(a) || m.stale || (m.futures.has(id) && !only)) return;
    const scene = editor.scene.peek()!;
    // The verdict on each future must hold when it is picked, so the others react to it.
    this.#ask({ agents: [id], react: whoReacts(scene, [id]), step: null, drafts: !only }, true);
  }

  /** A drag frame: the newest pose, one request on the way and one waiting. */
  preview(id: string): void {
    if (this.#connection.now) {
      this.#sketch(id);
      return;
    }
    const scene = this.editor.scene.peek();
    if (!scene) return;
    const pose = ++this.#pose;
    if (scene.others === 'react') this.#reactions.moved(scene);
    const anew = thoseWhoAnswer(scene, this.editor.answers.motion.peek(), [id]);
    this.#ask({ agents: [id], react: false, step: null, anew }, true, (shown) => {
      if (shown || pose === this.#pose) this.#reactions.yielded();
    });
  }

  // -------------------------------------------------------------- reactions of the others

  /** The request that a release would send for a dragged document. */
  #onRelease(scene: Scene): Wanted | null {
    const agent = this.editor.selection.peek();
    const asked = agent && requestForChange(this.editor, scene, { name: '', agent, undo: false });
    return asked && typeof asked !== 'string' ? { ...asked, drafts: false } : null;
  }

  #previewing(scene: Scene, on: Handlers): Question | null {
    const asked = this.#connection.now ? null : this.#onRelease(scene);
    return asked && this.#requests.make(scene, { ...asked, background: true }, true, on);
  }

  /** A preview of exactly this document answers the release; false when there is none. */
  #takeOver(scene: Scene, step: Step): boolean {
    const asked = requestForChange(this.editor, scene, step);
    if (typeof asked === 'string') return false;
    const end = this.#begin();
    const take = (known: Known | null): void => {
      if (known) {
        this.generator.cancel();
        this.#handler.takeOver(scene, known.final, asked, step, known.ms);
      } else this.#workOut(step);
      end();
    };
    const taken = this.#reactions.release(scene, take);
    if (!taken) end();
    return taken;
  }

  /** Drops the previews of a cancelled drag. */
  cancelPreviews(): void {
    this.#reactions.drop();
    this.generator.cancel();
    if (!this.editor.answers.motion.peek().stale || this.#connection.now) return;
    // A drag that began while a change was being computed has cancelled that request; it is sent again.
    this.#workOut({ name: TEXTS.change, agent: this.editor.selection.peek(), undo: true });
  }

  committed(scene: Scene, step: Step): void {
    const { editor } = this;
    this.saving.changed();
    clearTimeout(this.#rest);
    this.#rested();
    if (editor.answers.motion.peek().stale && !this.#connection.now && this.#takeOver(scene, step)) return;
    this.#reactions.drop();
    if (!editor.answers.motion.peek().stale) {
      this.#keep();
      this.generator.cancel();
      editor.answers.report({ kind: 'ready' });
      this.selected(editor.selection.peek());
      if (step.counting) void this.score(step);
    } else if (this.#connection.now) {
      this.#connection.wait();
      if (step.agent) this.#sketch(step.agent, true);
    } else if (step.everybody && !step.undo) this.#workOut(step);
    else {
      const rested = (this.#rested = this.#begin());
      this.#rest = setTimeout(() => {
        this.#workOut(step);
        rested();
      }, REST_MS);
    }
  }

  #keep(): void {
    this.saving.answered();
  }

  /** The Generate button: draws the motion of all road users again. */
  generateAll(): void {
    const scene = this.editor.scene.peek();
    if (scene) this.editor.commits.run(drawAnew(scene));
  }

  /** Tries the connection to the generator at once. */
  tryNow(): Promise<void> {
    return this.#connection.tryNow();
  }

  // -------------------------------------------------------------- a change

  /** Release, typed value, undo to an unknown state: the others react too. */
  #workOut(step: Step): void {
    const scene = this.editor.scene.peek();
    if (!scene) return;
    const asked = requestForChange(this.editor, scene, step);
    if (asked === 'nothing') this.#pristine(scene, step);
    else if (asked === 'known') void this.score(step);
    else this.#ask(asked);
  }

  /** No conditions remain: all replay the recording and, past its end, continue by the generator. */
  #pristine(scene: Scene, step: Step): void {
    const { editor } = this;
    if (scene.length > GOAL_TIME && scene.others === 'react') {
      const anew = new Set(editor.answers.motion.peek().driving);
      this.#ask({ agents: [], react: true, step, anew });
      return;
    }
    editor.answers.settle(scene, emptyMotion(sceneKey(scene)), null);
    void this.score(step);
    const selected = editor.selection.peek();
    if (selected) this.#look(selected);
  }

  /** `came` is called on each visible result and at the end, with whether a result was shown. */
  #ask(w: Wanted, preview = false, came?: (shown: boolean) => void): void {
    const { editor } = this;
    const scene = editor.scene.peek();
    if (!scene || this.#connection.now) return;
    const handlers = this.#untilAnswered(this.#handler.of(scene, w), came);
    this.generator.ask(this.#requests.make(scene, w, preview, handlers));
    if (!preview) editor.answers.report({ kind: 'refining', step: 0, steps: DEFAULTS.steps, ms: 0 });
  }

  /** Marks a request as open; the returned function ends it. */
  #begin(): () => void {
    const token = {};
    this.#open.add(token);
    this.#asking.value = true;
    return () => {
      this.#open.delete(token);
      this.#asking.value = this.#open.size > 0;
    };
  }

  /** The same handlers; the request counts as open until one of its endings. */
  #untilAnswered(on: Handlers, came?: (shown: boolean) => void): Handlers {
    const end = this.#begin();
    const ending =
      <A extends unknown[]>(shown: boolean, handle?: (...a: A) => void) =>
      (...a: A): void => {
        handle?.(...a);
        came?.(shown);
        end();
      };
    return {
      ...on,
      draft: (...a) => {
        on.draft(...a);
        came?.(true);
      },
      final: ending(true, on.final),
      refused: ending(true, on.refused),
      away: ending(false, on.away),
      dropped: ending(false, on.dropped),
    };
  }

  // -------------------------------------------------------------- scores

  /** Events of known motions: after a pick among futures, and of the recording at the start. */
  async score(step: Step | null = null, quiet = false): Promise<void> {
    const { editor } = this;
    const scene = editor.scene.peek();
    if (!scene || !this.file.raw) return;
    this.#scoring?.abort();
    const abort = (this.#scoring = new AbortController());
    const end = this.#begin();
    const shown = this.#shown(scene);
    if (editor.answers.motion.peek().stale) {
      editor.answers.settle(scene, shown, null);
      this.#keep();
    }
    try {
      const score = await scoreOf(this.generator, this.file, scene, shown, abort.signal);
      if (editor.scene.peek() !== scene) return;
      const known = editor.answers.motion.peek();
      const met = score ? rejudged(scene, known, score, step ? [...changedBy(step)] : []) : known.futures;
      const judged = score ? judgedCurves(scene, met, score) : met;
      editor.answers.scored(score, score && step?.counting ? countedAnew(scene, judged, score) : judged);
      if (step && !quiet) this.#handler.settled(step, 0);
    } catch (e) {
      // Without a score there are no events to show; the motions still hold.
      if (e instanceof Away && step) this.#away({ agents: [], react: false, step });
    } finally {
      end();
    }
    if (step && !quiet && editor.answers.status.peek().kind === 'refining') editor.answers.report({ kind: 'ready' });
  }

  /** The motions as the document has them now: conditioned road users follow their futures where there are any. */
  #shown(scene: Scene): MotionSet {
    const set = this.editor.answers.motion.peek();
    return { ...followed(scene, set), futures: withCurves(scene, set.futures), fresh: null };
  }

  // -------------------------------------------------------------- connection

  #away(w: Wanted): void {
    this.#connection.begin(w.step !== null);
    const id = w.step?.agent ?? (Array.isArray(w.agents) ? w.agents[0] : null);
    if (id) this.#sketch(id, true);
  }

  #back(waiting: number): void {
    const { editor } = this;
    this.saving.retry();
    const done = waiting ? TEXTS.changesComputed(waiting) : '';
    editor.notices.show({ text: TEXTS.theGenerator(done) });
    const scene = editor.scene.peek();
    // Each changed road user is asked again: its known futures may be from before its change.
    if (scene && editor.answers.motion.peek().stale)
      this.#workOut({ name: TEXTS.waitingChanges, agent: null, several: touchedIn(scene), undo: true });
    else this.selected(editor.selection.peek());
  }

  /** A plain curve in place of futures while the generator is unreachable. */
  #sketch(id: string, selectedOnly = false): void {
    const { editor } = this;
    const scene = editor.scene.peek();
    const a = scene?.agents.get(id);
    const f = scene && a ? sketchFutures(scene, a) : null;
    if (f && (!selectedOnly || editor.selection.peek() === id)) editor.answers.showDraft(id, f);
  }
}
