// The open scene as a file: as it came, and as it is written back with the user's changes in it.
import type { GeneratedJson, MapJson, SceneJson } from '../../model/json';
import type { MotionSet } from '../../model/futures';
import { rosterOfJson } from '../../model/read';
import type { Scene } from '../../model/scene';
import { castJson, generatedJson, variantSample, writeScene } from '../../model/write';
import type { SceneRef } from '../../net/generator';
import type { Editor } from '../editor';

interface VariantTake {
  readonly id: number;
  readonly scene: Scene;
  readonly set: MotionSet;
}

export class SceneFile {
  /** As it came from the server; null while nothing is open. */
  raw: SceneJson | null = null;
  map: MapJson | null = null;
  /** Hash by which the server knows the map. */
  mapRef: string | null = null;
  /** Does the server know this scene by its id? */
  stored = false;
  /** Variants whose motion is to be kept. */
  variantTakes: () => readonly VariantTake[] = () => [];
  #withConditions = new Set<string>();
  /** Who is in the version that the server holds. */
  #roster: string | null = null;

  constructor(private readonly editor: Editor) {}

  adopt(json: SceneJson, map: MapJson, stored: boolean): void {
    this.raw = json;
    this.map = map;
    this.mapRef = null;
    this.stored = stored;
    this.noteStored(json);
  }

  /** Does the server hold a scene of these road users under the id of this one? */
  holds(scene: Scene): boolean {
    return this.stored && this.#roster === scene.roster;
  }

  /** The server holds this version: who is in it, and whose conditions it knows: freed ones are sent as free. */
  noteStored(json: SceneJson): void {
    this.#roster = rosterOfJson(json);
    const asked = json.agents.filter((a) => a.conditions && Object.keys(a.conditions).length);
    this.#withConditions = new Set(asked.map((a) => a.id));
  }

  /** The scene for a question about its motions: by name where the server holds it, else with its cast. */
  reference(scene: Scene): SceneRef {
    if (this.holds(scene)) return { id: scene.id };
    const map = this.mapRef ? { ref: this.mapRef } : this.map!;
    return { scene: { ...this.raw!, agents: castJson(scene), map, generated: null } };
  }

  hadConditions(id: string): boolean {
    return this.#withConditions.has(id);
  }

  /** The scene with its changes and the futures that belong to them; the map by its hash where the server has it. */
  current(): SceneJson | null {
    const scene = this.editor.scene.peek();
    const json = scene && this.#written(scene, this.editor.motion.peek());
    return json && this.#withVariants(json);
  }

  /** Kept variants go with what everybody does in them: another generator may not draw them again. */
  #withVariants(json: SceneJson): SceneJson {
    const { generated, x_editor } = json;
    const kept = generated ? this.variantTakes() : [];
    if (!generated || !kept.length) return json;
    const index = new Map(kept.map(({ id }, i) => [id, generated.samples.length + i]));
    const variants = x_editor?.variants?.map((v) => (index.has(v.id) ? { ...v, sample: index.get(v.id) } : v));
    const samples = [...generated.samples, ...kept.map(({ scene, set }) => variantSample(scene, set))];
    return { ...json, generated: { ...generated, samples }, x_editor: { ...x_editor, variants } };
  }

  /** The futures that belong to the document; null while they are not known, and where nobody has any. */
  answers(): GeneratedJson | null {
    const scene = this.editor.scene.peek();
    return scene && answersIn(scene, this.editor.motion.peek());
  }

  #written(scene: Scene, m: MotionSet): SceneJson | null {
    if (!this.raw) return null;
    return writeScene(
      this.raw,
      scene,
      answersIn(scene, m),
      this.mapRef ? { ref: this.mapRef } : (this.map ?? undefined),
    );
  }

  /** A document as a file of its own, with the map inside. */
  completeOf(scene: Scene, set: MotionSet): SceneJson | null {
    const json = this.#written(scene, set);
    return json && this.map ? { ...json, map: this.map } : json;
  }

  /** The same with the map inside: for files, and for servers that do not know the map. */
  complete(): SceneJson | null {
    const json = this.current();
    return json && this.map ? { ...json, map: this.map } : json;
  }
}

function answersIn(scene: Scene, m: MotionSet): GeneratedJson | null {
  const driving = [...m.futures].filter(([id]) => m.driving.has(id));
  return m.stale ? null : generatedJson(scene, driving, m.head, m.answering);
}
