// The open scene as a file: as it came, and as it is written back with the committed changes in it.
import type { GeneratedJson, MapJson, SceneJson } from '../../model/document/scene-json';
import type { MotionSet } from '../../model/document/futures';
import type { Committed } from '../../model/document/history';
import { castKeyOfJson } from '../../model/document/scene-reader';
import { sceneKey, type Scene } from '../../model/document/scene';
import { castJson, generatedJson, variantSample, writeScene } from '../../model/document/scene-writer';
import type { SceneRef } from '../../net/generator';
import type { Session } from './session';

interface VariantTake {
  readonly id: number;
  readonly scene: Scene;
  readonly set: MotionSet;
}

/** A committed document as it is written, whatever is opened or changed after it. */
export interface Snapshot {
  readonly committed: Committed;
  readonly map: MapJson | null;
  /** With the futures that belong to it; the map by its hash where the server has it. */
  body(): SceneJson;
  /** The same with the map inside: for files, and for servers that do not know the map. */
  complete(): SceneJson;
}

export class SceneFile {
  /** As it came from the server; null while nothing is open. */
  raw: SceneJson | null = null;
  map: MapJson | null = null;
  /** Hash by which the server knows the map: the list of scenes may come after the scene. */
  mapHash: () => string | null = () => null;
  /** Does the server know this scene by its id? */
  stored = false;
  /** Variants whose motion is to be kept. */
  variantTakes: () => readonly VariantTake[] = () => [];
  #withConditions = new Set<string>();
  /** Who is in the version that the server holds. */
  #castKey: string | null = null;

  constructor(private readonly session: Session) {}

  adopt(json: SceneJson, map: MapJson, stored: boolean): void {
    this.raw = json;
    this.map = map;
    this.mapHash = () => null;
    this.stored = stored;
    this.noteStored(json);
  }

  /** The map as a request carries it: its hash where the server knows it, else the whole map. */
  sentMap(): SceneJson['map'] {
    const hash = this.mapHash();
    return hash ? { ref: hash } : this.map!;
  }

  /** Does the server hold a scene of these road users under the id of this one? */
  holds(scene: Scene): boolean {
    return this.stored && this.#castKey === scene.castKey;
  }

  /** The server holds this version: who is in it, and whose conditions it knows: freed ones are sent as free. */
  noteStored(json: SceneJson): void {
    this.#castKey = castKeyOfJson(json);
    const asked = json.agents.filter((a) => a.conditions && Object.keys(a.conditions).length);
    this.#withConditions = new Set(asked.map((a) => a.id));
  }

  /** The scene for a question about its motions: by name where the server holds it, else with its cast. */
  reference(scene: Scene): SceneRef {
    if (this.holds(scene)) return { id: scene.id };
    return { scene: { ...this.raw!, agents: castJson(scene), map: this.sentMap(), generated: null } };
  }

  hadConditions(id: string): boolean {
    return this.#withConditions.has(id);
  }

  /** The committed document as it is now; null while nothing is open. */
  snapshot(): Snapshot | null {
    const committed = this.session.document.committed.peek();
    const { raw, map } = this;
    if (!committed || !raw) return null;
    const { scene } = committed;
    const generated = this.answers();
    const takes = generated ? this.variantTakes() : [];
    let written: SceneJson | null = null;
    const body = (): SceneJson =>
      (written ??= withVariants(writeScene(raw, scene, generated, this.sentMap() ?? undefined), takes));
    return { committed, map, body, complete: () => (map ? { ...body(), map } : body()) };
  }

  /** The futures that belong to the committed document; null while they are not known, and where there are none. */
  answers(): GeneratedJson | null {
    const scene = this.session.document.scene.peek();
    const set = this.session.answers.motion.peek();
    return scene && set.key === sceneKey(scene) ? answersIn(scene, set) : null;
  }

  /** A document as a file of its own, with the map inside. */
  completeOf(scene: Scene, set: MotionSet): SceneJson | null {
    const { raw, map } = this;
    return raw && writeScene(raw, scene, answersIn(scene, set), map ?? undefined);
  }

  /** The committed document as a file, with the map inside. */
  complete(): SceneJson | null {
    return this.snapshot()?.complete() ?? null;
  }
}

/** Kept variants go with the motions of all road users in them: another generator may not draw them again. */
function withVariants(json: SceneJson, takes: readonly VariantTake[]): SceneJson {
  const { generated, x_editor } = json;
  if (!generated || !takes.length) return json;
  const index = new Map(takes.map(({ id }, i) => [id, generated.samples.length + i]));
  const variants = x_editor?.variants?.map((v) => (index.has(v.id) ? { ...v, sample: index.get(v.id) } : v));
  const samples = [...generated.samples, ...takes.map(({ scene, set }) => variantSample(scene, set))];
  return { ...json, generated: { ...generated, samples }, x_editor: { ...x_editor, variants } };
}

function answersIn(scene: Scene, m: MotionSet): GeneratedJson | null {
  const driving = [...m.futures].filter(([id]) => m.driving.has(id));
  return m.stale ? null : generatedJson(scene, driving, m.head, m.answering);
}
