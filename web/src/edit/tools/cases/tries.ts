// Tries for a case: the server makes and measures them; the page makes those again that it shows.
import { DEFAULTS, topSpeed } from '../../../model/base/domain';
import { conditionOn, situationOf, withTry, type MayChange, type Try } from '../../../model/physics/case-search';
import { momentOf, type Sought } from '../../../model/physics/cases';
import { choose } from '../../../model/document/commands';
import type { MotionSet } from '../../../model/document/futures';
import { thoseWhoAnswer } from '../../../model/document/reaction-records';
import { GOAL_TIME, type Scene } from '../../../model/document/scene';
import type { ConditionJson, SceneJson } from '../../../model/document/scene-json';
import type { Client } from '../../../net/client';
import type { Handlers } from '../../../net/generator';
import { triesOf } from '../../../net/searching';
import { whoReacts } from '../../asking/request-for-change';
import type { RequestBuilder, Wanted } from '../../asking/request-builder';
import { followed } from '../../asking/scoring';
import { Maker, type Take } from '../../asking/take-maker';
import type { Supplies } from '../feature';

/** A search: the scene and its motion at the start, and the target. */
export interface SearchOf {
  readonly scene: Scene;
  readonly set: MotionSet;
  readonly sought: Sought;
  readonly may: MayChange;
}

type CaseSupplies = Pick<Supplies, 'client' | 'editor' | 'file' | 'generator' | 'questions'>;

/** Most tries of one call: its time is limited, and the next one has other seeds. */
export const OF_A_CALL = 60;
/** Seeds of one call: each is a search of its own. */
const SEEDS = 3;
const UNHEARD: Handlers = {
  draft: () => undefined,
  final: () => undefined,
  refused: () => undefined,
  away: () => undefined,
};

export class CaseTries {
  readonly #client: Client;
  readonly #questions: RequestBuilder;
  readonly #maker: Maker;
  readonly #cancel: () => void;

  constructor({ client, editor, file, generator, questions }: CaseSupplies) {
    const own = generator();
    this.#client = client;
    this.#questions = questions();
    this.#maker = new Maker(editor, this.#questions, own, file);
    this.#cancel = () => own.cancel();
  }

  /** At most so many tries. Another `turn` makes others: its seeds are the next ones. */
  async *search(of: SearchOf, turn: number, most: number, over: AbortSignal): AsyncGenerator<Try> {
    const { scene, sought, may } = of;
    const a = scene.agents.get(sought.who)!;
    const ranges = situationOf(a, scene, may, topSpeed(a));
    // Tries with one seed and without a range are all the same.
    if (!ranges && !may.seed && turn > 0) return;
    const method = ranges ? 'search' : 'random';
    const each = ranges ? Math.ceil(most / (may.seed ? SEEDS : 1)) : 1;
    const seeds = may.seed ? Math.ceil(most / each) : 1;
    const { react, asked } = this.#asked(of);
    yield* triesOf(
      this.#client,
      asked,
      {
        situation: { ...(ranges ?? { agents: [a.id] }), ...(sought.other === null ? {} : { with: sought.other }) },
        where: conditionOn(sought),
        tries: each,
        method,
        seed: turn,
        seeds: Array.from({ length: seeds }, (_, i) => scene.seed + (may.seed ? turn * OF_A_CALL + i : 0)),
        generate: {
          react,
          diversity: scene.diversity,
          steps: DEFAULTS.steps,
          ...(scene.length > GOAL_TIME || scene.replan < GOAL_TIME
            ? { horizon_s: scene.length, replan_interval_s: scene.replan }
            : {}),
        },
      },
      over,
    );
  }

  /** The searched scene, with its conditions and the motion of the others. */
  #asked({ scene, set, sought: { who } }: SearchOf) {
    const wanted = wantedOf(scene, set, who);
    const question = this.#questions.makeApart(scene, without(set, who), wanted, UNHEARD);
    const { conditions } = question.options;
    const withConditions = (of: SceneJson): SceneJson => ({
      ...of,
      agents: of.agents.map((b) => ({ ...b, conditions: (conditions[b.id] ?? {}) as ConditionJson })),
    });
    const sent = question.scene();
    const whole = () => withConditions(question.whole());
    const asked = { scene: 'scene' in sent ? withConditions(sent.scene) : whole(), whole };
    return { react: wanted.react !== false, asked };
  }

  /**
   * Makes a try again, then with each other of its futures that would be a case: the server follows its own choice
   * alone. Nothing without a result, and where it starts inside of another road user.
   */
  async *open({ scene, set, sought }: SearchOf, { request }: Try): AsyncGenerator<Take> {
    const { who } = sought;
    const tried = request && withTry(scene, who, request);
    if (!tried) return;
    const made = await this.#maker.answered(tried, without(set, who), wantedOf(tried, set, who));
    const { chosen, modes } = made.futures.get(who)!;
    const picked = (which: number): Scene => choose(tried.agents.get(who)!, which, '').apply(tried);
    const isCase = (which: number): boolean => momentOf(picked(which), made, sought)?.found ?? false;
    const own = picked(chosen);
    yield { scene: own, set: followed(own, made) };
    for (const which of modes.keys())
      if (which !== chosen && isCase(which)) yield await this.#maker.after(picked(which), who, made);
  }

  /** Drops the try that is made again. */
  cancel(): void {
    this.#cancel();
  }
}

/** The others keep their motion, or react. */
const wantedOf = (scene: Scene, set: MotionSet, who: string): Wanted => ({
  agents: [who],
  react: whoReacts(scene, [who]),
  step: { name: '', agent: who, undo: false },
  kept: new Set([...scene.agents.values()].filter((a) => a.chosen !== null && a.id !== who).map((a) => a.id)),
  anew: thoseWhoAnswer(scene, set, [who]),
});

/** The motion without the futures of a road user. */
const without = (set: MotionSet, id: string): MotionSet => ({
  ...set,
  futures: new Map([...set.futures].filter(([other]) => other !== id)),
  driving: new Set([...set.driving].filter((other) => other !== id)),
});
