// From the document to a question: the scene, by name where the server has it as it is on screen, what is asked of
// whom, and the options.
import { DEFAULTS } from '../model/domain';
import type { ConditionJson, MapJson, MapRef, SceneJson } from '../model/json';
import type { MotionSet } from '../model/futures';
import { GOAL_TIME, type Scene } from '../model/scene';
import { conditionOf, generatedJson, isEmptyCondition, stillAgents } from '../model/write';
import type { Handlers, Question, SceneRef } from '../net/generator';
import type { GenerateOptions } from '../net/types';
import type { Editor, Step } from './editor';
import type { SceneFile } from './scene-file';
import { shownFuture } from './shown';

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
  readonly unscored?: boolean;
}

export class Questions {
  /** The scene as the last previews asked about it. */
  #last: { set: MotionSet; others: string; scene: SceneJson } | null = null;

  constructor(
    private readonly editor: Editor,
    private readonly file: SceneFile,
  ) {}

  make(scene: Scene, w: Wanted, preview: boolean, on: Handlers): Question {
    const set = this.editor.motion.peek();
    return {
      preview,
      on,
      options: this.#options(scene, w),
      scene: () => this.#reference(scene, set, w),
      whole: () => this.#written(scene, set, w, this.file.map!),
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
      stream_modes: 'all',
      score: w.step !== null && !w.unscored,
      ...shownOf(this.editor, w),
      // One window is the default and needs no words.
      ...(scene.length > GOAL_TIME || scene.replan < GOAL_TIME
        ? { horizon_s: scene.length, replan_interval_s: scene.replan }
        : {}),
    };
  }

  #reference(scene: Scene, set: MotionSet, w: Wanted): SceneRef {
    const { file } = this;
    const asStored = file.stored && !set.driving.size && !w.kept?.size && scene.others !== 'still';
    if (asStored) return { id: scene.id };
    const map = file.mapRef ? { ref: file.mapRef } : file.map!;
    if (w.step) return { scene: this.#written(scene, set, w, map) };
    // A drag asks sixty times a second about the same surroundings.
    const last = this.#last;
    if (last && last.set === set && last.others === scene.others) return { scene: last.scene };
    const written = this.#written(scene, set, w, map);
    this.#last = { set, others: scene.others, scene: written };
    return { scene: written };
  }

  #written(scene: Scene, set: MotionSet, w: Wanted, map: MapJson | MapRef): SceneJson {
    const raw = this.file.raw!;
    const kept = [...set.futures].filter(([id]) => set.driving.has(id) || w.kept?.has(id));
    const moving = new Set(this.editor.touchedIds(scene));
    const agents = scene.others === 'still' ? stillAgents(raw, scene, moving) : raw.agents;
    return { ...raw, map, agents, generated: generatedJson(scene, kept) };
  }
}

/** Only a drag and its release go on from what is shown; a look at somebody new starts afresh. */
function shownOf(editor: Editor, w: Wanted): Pick<GenerateOptions, 'shown'> {
  const shown = w.step || editor.dragging.peek() ? shownFuture(editor, w.agents) : undefined;
  return shown ? { shown } : {};
}
