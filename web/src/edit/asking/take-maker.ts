// Makes variants: for one road user its futures in turn, with the others' reactions to each; otherwise all road users
// with one seed after the other. Requests depend only on the document, so they can be repeated.
import { choose, drawAnew, patchScene } from '../../model/document/commands';
import { emptyMotion, LETTERS, type Futures, type KeepOrder, type MotionSet } from '../../model/document/futures';
import { poseAt, STEP_S } from '../../model/base/motion';
import { canMove, hasGoal, sceneKey, touchedIn, type Agent, type Scene } from '../../model/document/scene';
import { withTaken } from '../../model/document/pins';
import { motionOf } from '../../model/physics/playback';
import { readVariantSample } from '../../model/words/named-futures';
import { Away, Refused } from '../../net/client';
import type { Generator } from '../../net/generator';
import type { FinalEvent } from '../../net/types';
import { requestForChange } from './request-for-change';
import type { Step } from '../document/step';
import type { Editor } from '../session/editor';
import { motionAfter, rejudged } from './merge-answer';
import { followed, scoreOf } from './scoring';
import type { RequestBuilder, Wanted } from './request-builder';
import type { SceneFile } from '../document/scene-file';
import { TEXTS } from '../../texts/editing/variants';

/** A document and the motion of all road users in it. */
export interface Take {
  readonly scene: Scene;
  readonly set: MotionSet;
}

/** A newer request replaced this one. */
export class Stopped extends Error {}

/** Takes are alike if no road user is ever further apart than this, metres. */
const ALIKE_M = 0.5;
/** Attempts per wanted take, since some are alike. */
const TRIES = 3;

export class Maker {
  readonly #bases = new Map<string, Promise<MotionSet>>();

  constructor(
    private readonly editor: Editor,
    private readonly questions: RequestBuilder,
    private readonly generator: Generator,
    private readonly file: SceneFile,
  ) {}

  /** Yields takes in turn, no two alike; fewer where there are no more. */
  async *make(scene: Scene, subject: string | null, first: number, wanted: number): AsyncGenerator<Take> {
    this.#bases.clear();
    const made: Take[] = [];
    for (let k = 0; made.length < wanted && k < wanted * TRIES; k++) {
      const next = await this.#nth(scene, subject, first, k);
      if (!next || made.some((t) => alike(t, next))) continue;
      made.push(next);
      yield next;
    }
  }

  /** The motion of all road users in each of these documents, in order. */
  async *each(scenes: readonly Scene[], subject: string, dealt?: Futures): AsyncGenerator<Take> {
    this.#bases.clear();
    for (const scene of scenes) yield await this.workOut(scene, subject, dealt);
  }

  async #nth(scene: Scene, subject: string | null, first: number, k: number): Promise<Take | null> {
    if (subject === null) {
      const anew = withSeed(scene.drawn ? scene : drawAnew(scene).apply(scene), first + k);
      return this.workOut(anew, null);
    }
    const seeded = withSeed(scene, first + Math.floor(k / LETTERS.length));
    const base = await this.#base(seeded, subject);
    const which = k % LETTERS.length;
    if (which >= (base.futures.get(subject)?.modes.length ?? 0)) return null;
    return this.workOut(choose(seeded.agents.get(subject)!, which, '').apply(seeded), subject);
  }

  /** A variant of an earlier session: from the file, otherwise computed again. */
  async again(id: number, scene: Scene, subject: string | null): Promise<Take> {
    const kept = this.file.raw && readVariantSample(this.file.raw, id, scene);
    return kept ? { scene, set: await this.#scored(scene, kept) } : this.workOut(scene, subject);
  }

  /** The motion of all road users in a document. `dealt`: futures of the subject other than its usual ones. */
  async workOut(scene: Scene, subject: string | null, dealt?: Futures): Promise<Take> {
    const usual = subject === null ? emptyMotion('') : await this.#base(scene, subject);
    const own = subject !== null && dealt ? new Map(usual.futures).set(subject, dealt) : usual.futures;
    const base = { ...usual, futures: withTaken(scene, own) };
    return this.after(scene, subject, base);
  }

  /** The same after a change of the subject, from a known motion. */
  async after(scene: Scene, subject: string | null, base: MotionSet): Promise<Take> {
    const step: Step = { name: '', agent: subject, undo: false, ...(subject === null && scene.drawn ? EVERYBODY : {}) };
    const asked = requestForChange(this.editor, scene, step, base);
    if (typeof asked === 'string') return { scene, set: await this.#scored(scene, base) };
    return { scene, set: await this.answered(scene, base, asked) };
  }

  /** The six futures of a road user, before the others react. */
  #base(scene: Scene, subject: string): Promise<MotionSet> {
    const agents = scene.agents.get(subject)!;
    const open = choose(agents, null, '').apply(scene);
    const key = sceneKey(open);
    const known = this.#bases.get(key);
    if (known) return known;
    const mine = touchedIn(open);
    const who = open.drawn ? 'all' : mine.includes(subject) ? mine : [...mine, subject];
    const asking = this.answered(open, emptyMotion(''), { agents: who, react: false, step: null });
    this.#bases.set(key, asking);
    asking.catch(() => this.#bases.delete(key));
    return asking;
  }

  /** The motion of all road users after a request, from a known motion. */
  async answered(scene: Scene, base: MotionSet, w: Wanted): Promise<MotionSet> {
    const e = await this.#ask(scene, base, w);
    return motionAfter(base, scene, e, w, (a) => this.#letters(a, base));
  }

  /** A road user with a picked future keeps the letters of the pick. */
  #letters(a: Agent, base: MotionSet): KeepOrder {
    const like = base.futures.get(a.id) ?? this.editor.answers.motion.peek().futures.get(a.id);
    return a.chosen !== null && like ? { like, always: true } : 'rank';
  }

  #ask(scene: Scene, base: MotionSet, w: Wanted): Promise<FinalEvent> {
    return new Promise((resolve, reject) => {
      const question = this.questions.makeApart(scene, base, w, {
        draft: () => undefined,
        final: resolve,
        refused: (p) => reject(new Refused(p.status ?? 422, p)),
        away: () => reject(new Away(TEXTS.theGenerator)),
        dropped: () => reject(new Stopped()),
      });
      this.generator.ask(question);
    });
  }

  /** The motions are known; only their events are requested. */
  async #scored(scene: Scene, base: MotionSet): Promise<MotionSet> {
    const set = followed(scene, base);
    const score = await scoreOf(this.generator, this.file, scene, set);
    return score ? { ...set, futures: rejudged(scene, set, score, []), score } : { ...set, score };
  }
}

const EVERYBODY = { everybody: true } as const;

const withSeed = (scene: Scene, seed: number): Scene => patchScene('', { seed }).apply(scene);

/** The road user to make variants of: the selected one, otherwise the only one with a goal; null for all. */
export function subjectOf(editor: Editor): string | null {
  const scene = editor.scene.value;
  const selected = editor.agent.value;
  if (selected && canMove(selected)) return selected.id;
  const asked = [...(scene?.agents.values() ?? [])].filter((a) => canMove(a) && hasGoal(a.goal));
  return asked.length === 1 ? asked[0].id : null;
}

function alike(a: Take, b: Take): boolean {
  for (const agent of a.scene.agents.values()) {
    const m = motionOf(a.scene, a.set, agent),
      n = motionOf(b.scene, b.set, b.scene.agents.get(agent.id)!);
    if (m === n) continue;
    for (let t = 0; t <= a.scene.duration + STEP_S / 2; t += 5 * STEP_S) {
      const p = poseAt(m, t),
        q = poseAt(n, t);
      if (p && q && Math.hypot(p.x - q.x, p.y - q.y) > ALIKE_M) return false;
    }
  }
  return true;
}
