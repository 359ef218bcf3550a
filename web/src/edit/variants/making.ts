// How variants come about: of one road user its futures, one after the other, with what the others do about each; else
// everybody anew with seed after seed. What is asked depends on the document alone, so that it can be asked again.
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
import { askedAfter } from '../after-change';
import type { Step } from '../document/step';
import type { Editor } from '../editor';
import { motionAfter, rejudged } from '../motion-after';
import { followed, scoreOf } from '../scoring';
import type { Questions, Wanted } from '../question';
import type { SceneFile } from '../document/scene-file';
import { TEXTS } from '../../texts/editing/variants';

/** A document and what everybody does in it. */
export interface Take {
  readonly scene: Scene;
  readonly set: MotionSet;
}

/** Somebody asked for something else meanwhile. */
export class Stopped extends Error {}

/** Two in which nobody is ever further apart than this are the same, metres. */
const ALIKE_M = 0.5;
/** So many more than wanted are tried where some are alike. */
const TRIES = 3;

export class Maker {
  readonly #bases = new Map<string, Promise<MotionSet>>();

  constructor(
    private readonly editor: Editor,
    private readonly questions: Questions,
    private readonly generator: Generator,
    private readonly file: SceneFile,
  ) {}

  /** Gives one after the other, no two alike; fewer where there are no more. */
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

  /** What everybody does in each of these documents, one after the other. */
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

  /** The six futures of a road user in a document, while nobody answers them. */
  futuresOf(scene: Scene, subject: string): Promise<MotionSet> {
    return this.#base(scene, subject);
  }

  /** Nothing is asked of documents any more that were asked about before. */
  forget(): void {
    this.#bases.clear();
  }

  /** A variant of last time: as the file keeps it, else worked out again. */
  async again(id: number, scene: Scene, subject: string | null): Promise<Take> {
    const kept = this.file.raw && readVariantSample(this.file.raw, id, scene);
    return kept ? { scene, set: await this.#scored(scene, kept) } : this.workOut(scene, subject);
  }

  /** What everybody does in a document. `dealt`: futures of the subject that are not its usual ones. */
  async workOut(scene: Scene, subject: string | null, dealt?: Futures): Promise<Take> {
    const usual = subject === null ? emptyMotion('') : await this.#base(scene, subject);
    const own = subject !== null && dealt ? new Map(usual.futures).set(subject, dealt) : usual.futures;
    const base = { ...usual, futures: withTaken(scene, own) };
    const step: Step = { name: '', agent: subject, undo: false, ...(subject === null && scene.drawn ? EVERYBODY : {}) };
    const asked = askedAfter(this.editor, scene, step, base);
    if (typeof asked === 'string') return { scene, set: await this.#scored(scene, base) };
    return { scene, set: await this.#answered(scene, base, asked) };
  }

  /** The six futures of a road user with nobody answering to them yet. */
  #base(scene: Scene, subject: string): Promise<MotionSet> {
    const agents = scene.agents.get(subject)!;
    const open = choose(agents, null, '').apply(scene);
    const key = sceneKey(open);
    const known = this.#bases.get(key);
    if (known) return known;
    const mine = touchedIn(open);
    const who = open.drawn ? 'all' : mine.includes(subject) ? mine : [...mine, subject];
    const asking = this.#answered(open, emptyMotion(''), { agents: who, react: false, step: null });
    this.#bases.set(key, asking);
    asking.catch(() => this.#bases.delete(key));
    return asking;
  }

  async #answered(scene: Scene, base: MotionSet, w: Wanted): Promise<MotionSet> {
    const e = await this.#ask(scene, base, w);
    return motionAfter(base, scene, e, w, (a) => this.#letters(a, base));
  }

  /** Whoever has a pick keeps the letters that it was picked by. */
  #letters(a: Agent, base: MotionSet): KeepOrder {
    const like = base.futures.get(a.id) ?? this.editor.motion.peek().futures.get(a.id);
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

  /** The motions are known already; what happens in them is asked. */
  async #scored(scene: Scene, base: MotionSet): Promise<MotionSet> {
    const set = followed(scene, base);
    const score = await scoreOf(this.generator, this.file, scene, set);
    return score ? { ...set, futures: rejudged(scene, set, score, []), score } : { ...set, score };
  }
}

const EVERYBODY = { everybody: true } as const;

const withSeed = (scene: Scene, seed: number): Scene => patchScene('', { seed }).apply(scene);

/** Of whom variants are made: who is selected, else who has a goal; null where it is everybody. */
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
