// What is asked of the generator, and when: six futures of whom one selects, live ones during a drag, everybody's
// answer after a change. What becomes of the answers is in `reception.ts`.
import { signal, type ReadonlySignal } from '@preact/signals-core';
import { DEFAULTS } from '../model/base/domain';
import { goesOneWay, thoseWhoAnswer } from '../model/document/reaction-records';
import { emptyMotion, type MotionSet } from '../model/document/futures';
import { drawAnew } from '../model/document/commands';
import { canChange, GOAL_TIME, sceneKey, type Scene } from '../model/document/scene';
import { countedAnew } from '../model/physics/verdict-updates';
import { Away } from '../net/client';
import type { Generator, Handlers, Question } from '../net/generator';
import { Absence } from './absence';
import { askedAfter, changedBy, whoReacts } from './after-change';
import { rejudged } from './motion-after';
import { followed, scoreOf } from './scoring';
import type { Step } from './document/step';
import type { Editor } from './editor';
import { Foresight, type Known } from './foresight';
import type { Previews } from './gestures/chart';
import { Questions, type Wanted } from './question';
import { Reception } from './reception';
import type { Saving } from './document/saving';
import type { SceneFile } from './document/scene-file';
import { sketchFutures } from './sketch';
import { judgedCurves, withCurves } from './speed-curve';
import { TEXTS } from '../texts/editing/generation';

/** A key held down asks once, when it rests. */
const REST_MS = 80;

export class Generation implements Previews {
  readonly #questions: Questions;
  readonly #reception: Reception;
  readonly #absence: Absence;
  readonly #foresight: Foresight;
  /** Counts the poses of drags. */
  #pose = 0;
  readonly #busy = signal(false);
  /** What is asked and not answered yet, and a change that rests before it is asked about. */
  readonly #open = new Set<object>();
  #rest: ReturnType<typeof setTimeout> | undefined;
  #rested: () => void = () => undefined;
  #scoring: AbortController | null = null;

  /** Is anything asked, or about to be? */
  readonly busy: ReadonlySignal<boolean> = this.#busy;

  constructor(
    private readonly editor: Editor,
    private readonly file: SceneFile,
    private readonly saving: Saving,
    private readonly generator: Generator,
    /** A line of its own for what the others would do. */
    others: Generator,
  ) {
    this.#questions = new Questions(editor, file);
    this.#absence = new Absence(
      editor,
      () => generator.answers(),
      (waiting) => this.#back(waiting),
    );
    this.#reception = new Reception(editor, {
      answered: () => this.#absence.end(),
      away: (w) => this.#away(w),
      askAgain: (w) => this.#ask(w),
      look: (id) => this.#look(id),
      score: (step) => void this.score(step, true),
      known: () => this.#keep(),
    });
    this.#foresight = new Foresight(others, {
      question: (scene, on) => this.#foreseeing(scene, on),
      foresee: (scene, e) => {
        const asked = this.#onRelease(scene);
        if (asked) this.#reception.foresee(scene, e, asked);
      },
      begin: () => this.#begin(),
    });
    editor.onCommit = (scene, step) => this.#committed(scene, step);
    editor.onSelect = (id) => this.#selected(id);
  }

  // -------------------------------------------------------------- what sets it off

  /** A scene was opened that lacks the answers to what is changed in it. */
  opened(everybody: boolean): void {
    const scene = this.editor.scene.peek();
    const step = { name: TEXTS.sceneOpened, agent: null, undo: true, ...(everybody ? { everybody } : {}) };
    if (scene) this.#committed(scene, step);
  }

  #selected(id: string | null): void {
    if (id) {
      this.#look(id);
      return;
    }
    const { answers, motion, status } = this.editor;
    // A running answer to a change must still arrive; only a look at futures is dropped.
    if (motion.peek().stale) return;
    this.generator.cancel();
    // What was said about its futures goes with it.
    if (['refining', 'slow', 'settled'].includes(status.peek().kind)) answers.report({ kind: 'ready' });
  }

  /** The six futures of one; nobody follows them yet, and nobody else moves. */
  #look(id: string): void {
    const { editor } = this;
    const a = editor.agent.peek();
    const m = editor.motion.peek();
    const only = a !== null && goesOneWay(m, a);
    if (a && canChange(a) && this.#absence.now && !only) this.#sketch(id, true);
    if (!a || !canChange(a) || m.stale || (m.futures.has(id) && !only)) return;
    const scene = editor.scene.peek()!;
    // What is said of each holds when it is picked: the others answer it then.
    this.#ask({ agents: [id], react: whoReacts(scene, [id]), step: null, drafts: !only }, true);
  }

  /** A drag frame: the newest pose, one request on the way and one waiting. */
  preview(id: string): void {
    if (this.#absence.now) {
      this.#sketch(id);
      return;
    }
    const scene = this.editor.scene.peek();
    if (!scene) return;
    const pose = ++this.#pose;
    if (scene.others === 'react') this.#foresight.moved(scene);
    const anew = thoseWhoAnswer(scene, this.editor.motion.peek(), [id]);
    this.#ask({ agents: [id], react: false, step: null, anew }, true, (shown) => {
      if (shown || pose === this.#pose) this.#foresight.yielded();
    });
  }

  // -------------------------------------------------------------- what the others would do

  /** What a release would ask of a document that is being dragged. */
  #onRelease(scene: Scene): Wanted | null {
    const agent = this.editor.selection.peek();
    const asked = agent && askedAfter(this.editor, scene, { name: '', agent, undo: false });
    return asked && typeof asked !== 'string' ? { ...asked, drafts: false } : null;
  }

  #foreseeing(scene: Scene, on: Handlers): Question | null {
    const asked = this.#absence.now ? null : this.#onRelease(scene);
    return asked && this.#questions.make(scene, { ...asked, background: true }, true, on);
  }

  /** The release takes over what was foreseen of exactly this document; false when nothing was. */
  #takeOver(scene: Scene, step: Step): boolean {
    const asked = askedAfter(this.editor, scene, step);
    if (typeof asked === 'string') return false;
    const end = this.#begin();
    const take = (known: Known | null): void => {
      if (known) {
        this.generator.cancel();
        this.#reception.takeOver(scene, known.final, asked, step, known.ms);
      } else this.#workOut(step);
      end();
    };
    const taken = this.#foresight.release(scene, take);
    if (!taken) end();
    return taken;
  }

  /** Drops the previews of a drag that was put back. */
  cancelPreviews(): void {
    this.#foresight.drop();
    this.generator.cancel();
    if (!this.editor.motion.peek().stale || this.#absence.now) return;
    // A drag that began while a change was being worked out has pushed that aside; it is asked for again.
    this.#workOut({ name: TEXTS.change, agent: this.editor.selection.peek(), undo: true });
  }

  #committed(scene: Scene, step: Step): void {
    const { editor } = this;
    this.saving.changed();
    clearTimeout(this.#rest);
    this.#rested();
    if (editor.motion.peek().stale && !this.#absence.now && this.#takeOver(scene, step)) return;
    this.#foresight.drop();
    if (!editor.motion.peek().stale) {
      this.#keep();
      this.generator.cancel();
      editor.answers.report({ kind: 'ready' });
      this.#selected(editor.selection.peek());
      if (step.counting) void this.score(step);
    } else if (this.#absence.now) {
      this.#absence.wait();
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

  /** The Generate button: everybody anew. */
  generateAll(): void {
    const scene = this.editor.scene.peek();
    if (scene) this.editor.run(drawAnew(scene));
  }

  /** Asks at once whether the generator is back. */
  tryNow(): Promise<void> {
    return this.#absence.tryNow();
  }

  // -------------------------------------------------------------- a change

  /** Release, typed value, undo to an unknown state: the others are asked too. */
  #workOut(step: Step): void {
    const scene = this.editor.scene.peek();
    if (!scene) return;
    const asked = askedAfter(this.editor, scene, step);
    if (asked === 'nothing') this.#pristine(scene, step);
    else if (asked === 'known') void this.score(step);
    else this.#ask(asked);
  }

  /** Nobody is asked anything: everybody follows the log again and, past its end, goes on by the generator. */
  #pristine(scene: Scene, step: Step): void {
    const { editor } = this;
    if (scene.length > GOAL_TIME && scene.others === 'react') {
      const anew = new Set(editor.motion.peek().driving);
      this.#ask({ agents: [], react: true, step, anew });
      return;
    }
    editor.answers.settle(scene, emptyMotion(sceneKey(scene)), null);
    void this.score(step);
    const selected = editor.selection.peek();
    if (selected) this.#look(selected);
  }

  /** `came` is called when something came of it, and when it ends, with whether there was something to be seen. */
  #ask(w: Wanted, preview = false, came?: (shown: boolean) => void): void {
    const { editor } = this;
    const scene = editor.scene.peek();
    if (!scene || this.#absence.now) return;
    const handlers = this.#untilAnswered(this.#reception.of(scene, w), came);
    this.generator.ask(this.#questions.make(scene, w, preview, handlers));
    if (!preview) editor.answers.report({ kind: 'refining', step: 0, steps: DEFAULTS.steps, ms: 0 });
  }

  /** Something is open from now on; what it gives back ends it. */
  #begin(): () => void {
    const token = {};
    this.#open.add(token);
    this.#busy.value = true;
    return () => {
      this.#open.delete(token);
      this.#busy.value = this.#open.size > 0;
    };
  }

  /** The same handlers, with the question open until one of its endings. */
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

  /** Events of motions that are known already: after a pick among futures, and of the log at the start. */
  async score(step: Step | null = null, quiet = false): Promise<void> {
    const { editor } = this;
    const scene = editor.scene.peek();
    if (!scene || !this.file.raw) return;
    this.#scoring?.abort();
    const abort = (this.#scoring = new AbortController());
    const end = this.#begin();
    const shown = this.#shown(scene);
    if (editor.motion.peek().stale) {
      editor.answers.settle(scene, shown, null);
      this.#keep();
    }
    try {
      const score = await scoreOf(this.generator, this.file, scene, shown, abort.signal);
      if (editor.scene.peek() !== scene) return;
      const known = editor.motion.peek();
      const met = score ? rejudged(scene, known, score, step ? [...changedBy(step)] : []) : known.futures;
      const judged = score ? judgedCurves(scene, met, score) : met;
      editor.answers.scored(score, score && step?.counting ? countedAnew(scene, judged, score) : judged);
      if (step && !quiet) this.#reception.settled(step, 0);
    } catch (e) {
      // Without a score there are no events to show; the motions stand.
      if (e instanceof Away && step) this.#away({ agents: [], react: false, step });
    } finally {
      end();
    }
    if (step && !quiet && editor.status.peek().kind === 'refining') editor.answers.report({ kind: 'ready' });
  }

  /** The motions as the document has them now: those asked something follow their futures where there are any. */
  #shown(scene: Scene): MotionSet {
    const set = this.editor.motion.peek();
    return { ...followed(scene, set), futures: withCurves(scene, set.futures), fresh: null };
  }

  // -------------------------------------------------------------- absence

  #away(w: Wanted): void {
    this.#absence.begin(w.step !== null);
    const id = w.step?.agent ?? (Array.isArray(w.agents) ? w.agents[0] : null);
    if (id) this.#sketch(id, true);
  }

  #back(waiting: number): void {
    const { editor } = this;
    this.saving.retry();
    const done = waiting ? TEXTS.changesWorked(waiting) : '';
    editor.notices.show({ text: TEXTS.theGenerator(done) });
    const agent = editor.selection.peek();
    if (editor.motion.peek().stale) this.#workOut({ name: TEXTS.waitingChanges, agent, undo: true });
    else this.#selected(agent);
  }

  /** A plain curve in place of futures. */
  #sketch(id: string, selectedOnly = false): void {
    const { editor } = this;
    const scene = editor.scene.peek();
    const a = scene?.agents.get(id);
    const f = scene && a ? sketchFutures(scene, a) : null;
    if (f && (!selectedOnly || editor.selection.peek() === id)) editor.answers.showDraft(id, f);
  }
}
