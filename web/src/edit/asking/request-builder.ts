// Builds a request from the document: the scene (by name where the server holds the same version), the conditioned road
// users, and the options.
import { DEFAULTS } from '../../model/base/domain';
import type { ConditionJson, FeedbackDocJson, MapJson, MapRef, SceneJson } from '../../model/document/scene-json';
import type { Futures, MotionSet } from '../../model/document/futures';
import { doing, GOAL_TIME, profileOf, touchedIn, type Scene } from '../../model/document/scene';
import { asIfNotAsked } from '../../model/document/reaction-records';
import {
  castJson,
  conditionOf,
  generatedJson,
  isEmptyCondition,
  timedJson,
  thresholdsOf,
  withStill,
} from '../../model/document/scene-writer';
import type { Handlers, Question, SceneRef } from '../../net/generator';
import type { GenerateOptions } from '../../net/types';
import type { Step } from '../document/step';
import type { Editor } from '../session/editor';
import type { SceneFile } from '../document/scene-file';
import { shownFuture } from './shown-future';
import { withCurve } from './drawn-speeds';

/** Content of a generator request. */
export interface Wanted {
  /** Road users to compute again. */
  readonly agents: string[] | 'all';
  /** Other road users that react to them. */
  readonly react: boolean | string[];
  /** The change this answers; null for futures of a selection that no road user follows yet. */
  readonly step: Step | null;
  /** Road users that keep their futures; these count as the motion of the scene. */
  readonly kept?: ReadonlySet<string>;
  /** Road users that reacted to an earlier change of this kind: they start from the plan they gave up for it. */
  readonly anew?: ReadonlySet<string>;
  /** Road users whose kept futures the others react to as if requested. */
  readonly pinned?: readonly string[];
  readonly unscored?: boolean;
  /** Requests preference cards in place of the likeliest futures, using earlier feedback. */
  readonly feedback?: FeedbackDocJson;
  /** Are drafts shown before the answer? True unless set to false. */
  readonly drafts?: boolean;
  /** The drag's own requests go before this one, on the server too. */
  readonly background?: boolean;
}

/** A draft shown for less than one frame would not be seen, nor one before an answer in the same frame. */
const DRAFTS = { stream_modes: 'all', draft_delay_ms: 8, draft_interval_ms: 16 } as const;
/** For requests whose drafts are not shown. */
const ANSWER_ALONE = { stream_modes: 'chosen', draft_delay_ms: 1000, draft_interval_ms: 1000 } as const;

export class RequestBuilder {
  /** The scene of the last drag requests: the selected road user's own, and the reaction preview. */
  readonly #last = new Map<boolean, { set: MotionSet; rest: string; scene: SceneJson }>();

  constructor(
    private readonly editor: Pick<Editor, 'answers' | 'drag' | 'reading' | 'selection'>,
    private readonly file: SceneFile,
  ) {}

  make(scene: Scene, w: Wanted, preview: boolean, on: Handlers): Question {
    const set = this.editor.answers.motion.peek();
    return {
      preview,
      on,
      options: { ...this.#options(scene, set, w), ...shownOf(this.editor, w) },
      scene: () => this.#reference(scene, set, w, preview),
      whole: () => this.#written(scene, set, w, this.file.wholeMap(scene.laneRules)!),
    };
  }

  /**
   * The same, independent of the shown state and of the scene stored on the server: all road users move as in `set`.
   */
  makeApart(scene: Scene, set: MotionSet, w: Wanted, on: Handlers): Question {
    return {
      preview: false,
      on,
      options: { ...this.#options(scene, set, w), ...ANSWER_ALONE },
      scene: () => ({ scene: this.#written(scene, set, w, this.file.sentMap(scene)) }),
      whole: () => this.#written(scene, set, w, this.file.wholeMap(scene.laneRules)!),
    };
  }

  #options(scene: Scene, set: MotionSet, w: Wanted): GenerateOptions {
    const conditions: Record<string, ConditionJson> = {};
    const counts = new Set([...w.agents, ...keptIn(set, w).map(([id]) => id)]);
    for (const a of scene.agents.values()) {
      // The server refuses a start, goal or via point that would change no motion.
      const c = w.agents === 'all' || counts.has(a.id) ? conditionOf(a) : sizeAndType(conditionOf(a));
      if (!isEmptyCondition(c) || this.file.hadConditions(a.id)) conditions[a.id] = c;
    }
    return {
      agents: w.agents,
      react: w.react,
      conditions,
      seed: scene.seed,
      diversity: scene.diversity,
      steps: DEFAULTS.steps,
      ...(w.drafts === false ? ANSWER_ALONE : DRAFTS),
      // The editor already holds the kept futures of the others.
      kept_futures: 'omitted',
      score: w.step !== null && !w.unscored,
      ...thresholdsOf(scene),
      ...(w.feedback ? { feedback: w.feedback } : {}),
      ...(w.background ? { background: true } : {}),
      ...(w.pinned ? { pinned: [...w.pinned] } : {}),
      // One window is the default and needs no options.
      ...(scene.length > GOAL_TIME || scene.replan < GOAL_TIME
        ? { horizon_s: scene.length, replan_interval_s: scene.replan }
        : {}),
    };
  }

  #reference(scene: Scene, set: MotionSet, w: Wanted, preview: boolean): SceneRef {
    const { file } = this;
    const asStored = file.holds(scene) && !set.driving.size && !w.kept?.size && !someStill(scene);
    if (asStored) return { id: scene.id };
    const map = file.sentMap(scene);
    if (!preview) return { scene: this.#written(scene, set, w, map) };
    // A drag sends sixty requests a second with the same surroundings.
    const does = [...scene.agents.values()].flatMap((a) => (a.does ? [a.id, a.does] : []));
    const rest = JSON.stringify([scene.others, does, scene.castKey, [...(w.kept ?? [])], [...(w.anew ?? [])]]);
    const last = this.#last.get(w.step !== null);
    if (last && last.set === set && last.rest === rest) return { scene: last.scene };
    const written = this.#written(scene, set, w, map);
    this.#last.set(w.step !== null, { set, rest, scene: written });
    return { scene: written };
  }

  #written(scene: Scene, now: MotionSet, w: Wanted, map: MapJson | MapRef): SceneJson {
    const raw = this.file.raw!;
    const kept = keptIn(now, w);
    const moving = new Set(touchedIn(scene));
    const cast = castJson(scene);
    const agents = someStill(scene) ? withStill(scene, cast, moving) : cast;
    return {
      ...raw,
      ...timedJson(raw, scene),
      map,
      agents,
      generated: generatedJson(
        scene,
        kept.map(([id, f]) => [id, inForce(scene, id, f)]),
      ),
    };
  }
}

/** Futures that a request sends with its scene. */
function keptIn(now: MotionSet, w: Wanted): [string, Futures][] {
  const set = asIfNotAsked(now, w.anew);
  return [...set.futures].filter(([id, f]) => f.modes.length > 0 && (set.driving.has(id) || w.kept?.has(id)));
}

const sizeAndType = (c: ConditionJson): ConditionJson =>
  Object.fromEntries(Object.entries(c).filter(([name]) => !['start', 'goal', 'via'].includes(name)));

const someStill = (s: Scene): boolean =>
  s.others === 'still' || [...s.agents.values()].some((a) => doing(s, a) === 'still');

/**
 * Only the frames of a drag continue from the future shown before, for steadiness. The answer to a release, and its
 * preview, follow from the document alone: no speed of the hand decides, and a typed goal has the same futures.
 */
function shownOf(editor: Pick<Editor, 'drag' | 'reading' | 'selection'>, w: Wanted): Pick<GenerateOptions, 'shown'> {
  const shown = editor.drag.active.peek() && w.step === null ? shownFuture(editor, w.agents) : undefined;
  return shown ? { shown } : {};
}

/** Only the followed future: the others react to no other, and it is a sixth of the text. */
function inForce(scene: Scene, id: string, f: Futures): Futures {
  const a = scene.agents.get(id);
  const index = Math.min(f.modes.length - 1, a?.chosen ?? f.chosen);
  const drawn = a && profileOf(a);
  const chosen = (drawn ? withCurve(f, index, drawn, a, scene.duration) : f).modes[index];
  return { ...f, modes: chosen ? [chosen] : [], chosen: 0 };
}
