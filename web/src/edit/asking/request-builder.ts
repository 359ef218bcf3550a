// From the document to a question: the scene, by name where the server has it as it is on screen, what is asked of
// whom, and the options.
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

/** What is wanted of the generator. */
export interface Wanted {
  /** Who is worked out anew. */
  readonly agents: string[] | 'all';
  /** Who else answers them. */
  readonly react: boolean | string[];
  /** The change this answers; null for a look at futures that nobody follows yet. */
  readonly step: Step | null;
  /** Those whose futures are kept as they are and count as what the scene does. */
  readonly kept?: ReadonlySet<string>;
  /** Those that answered an earlier change of this kind: they begin again at what they gave up for it. */
  readonly anew?: ReadonlySet<string>;
  /** Those of them that others are to answer as if they had been asked for. */
  readonly pinned?: readonly string[];
  readonly unscored?: boolean;
  /** Cards are wanted in place of the likeliest futures, by what was said of earlier ones. */
  readonly feedback?: FeedbackDocJson;
  /** Does anybody look at drafts on the way to the answer? Yes, unless this says no. */
  readonly drafts?: boolean;
  /** The hand's own questions go before this one, on the server too. */
  readonly background?: boolean;
}

/**
 * A draft that stays for less than a picture on the screen would not be seen; nor would one before an answer that
 * comes in the same picture.
 */
const DRAFTS = { stream_modes: 'all', draft_delay_ms: 8, draft_interval_ms: 16 } as const;
/** Where nobody looks at drafts. */
const ANSWER_ALONE = { stream_modes: 'chosen', draft_delay_ms: 1000, draft_interval_ms: 1000 } as const;

export class RequestBuilder {
  /** The scene as the last questions of a drag asked about it: the hero's own, and what the others would do. */
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
      options: { ...this.#options(scene, w), ...shownOf(this.editor, w) },
      scene: () => this.#reference(scene, set, w, preview),
      whole: () => this.#written(scene, set, w, this.file.map!),
    };
  }

  /** The same whatever is on screen, and whatever the server keeps beside the scene: everybody does as in `set`. */
  makeApart(scene: Scene, set: MotionSet, w: Wanted, on: Handlers): Question {
    const { map } = this.file;
    return {
      preview: false,
      on,
      options: { ...this.#options(scene, w), ...ANSWER_ALONE },
      scene: () => ({ scene: this.#written(scene, set, w, this.file.sentMap()) }),
      whole: () => this.#written(scene, set, w, map!),
    };
  }

  #options(scene: Scene, w: Wanted): GenerateOptions {
    const conditions: Record<string, ConditionJson> = {};
    for (const a of scene.agents.values()) {
      const c = conditionOf(a);
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
      // What it knows of the others it has itself.
      kept_futures: 'omitted',
      score: w.step !== null && !w.unscored,
      ...thresholdsOf(scene),
      ...(w.feedback ? { feedback: w.feedback } : {}),
      ...(w.background ? { background: true } : {}),
      ...(w.pinned ? { pinned: [...w.pinned] } : {}),
      // One window is the default and needs no words.
      ...(scene.length > GOAL_TIME || scene.replan < GOAL_TIME
        ? { horizon_s: scene.length, replan_interval_s: scene.replan }
        : {}),
    };
  }

  #reference(scene: Scene, set: MotionSet, w: Wanted, preview: boolean): SceneRef {
    const { file } = this;
    const asStored = file.holds(scene) && !set.driving.size && !w.kept?.size && !someStill(scene);
    if (asStored) return { id: scene.id };
    const map = file.sentMap();
    if (!preview) return { scene: this.#written(scene, set, w, map) };
    // A drag asks sixty times a second about the same surroundings.
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
    const set = asIfNotAsked(now, w.anew);
    const kept = [...set.futures].filter(([id]) => set.driving.has(id) || w.kept?.has(id));
    const moving = new Set(touchedIn(scene));
    const cast = castJson(scene);
    const agents = someStill(scene) ? withStill(scene, cast, moving) : cast;
    return {
      ...raw,
      map,
      agents,
      generated: generatedJson(
        scene,
        kept.map(([id, f]) => [id, inForce(scene, id, f)]),
      ),
    };
  }
}

const someStill = (s: Scene): boolean =>
  s.others === 'still' || [...s.agents.values()].some((a) => doing(s, a) === 'still');

/** Only a drag and its release go on from what is shown; everything else is answered the same whatever was before. */
type Shown = Pick<GenerateOptions, 'shown'>;

function shownOf(editor: Pick<Editor, 'answers' | 'drag' | 'reading' | 'selection'>, w: Wanted): Shown {
  const drags =
    editor.drag.active.peek() || (w.step !== null && editor.answers.draft.peek()?.id === editor.selection.peek());
  const shown = drags && !w.pinned ? shownFuture(editor, w.agents) : undefined;
  return shown ? { shown } : {};
}

/** The one future that is followed: it is all that others are worked out against, and a sixth of the text. */
function inForce(scene: Scene, id: string, f: Futures): Futures {
  const a = scene.agents.get(id);
  const index = Math.min(f.modes.length - 1, a?.chosen ?? f.chosen);
  const drawn = a && profileOf(a);
  const chosen = (drawn ? withCurve(f, index, drawn, a, scene.duration) : f).modes[index];
  return { ...f, modes: chosen ? [chosen] : [], chosen: 0 };
}
