// The open scene as a file: as it was read, and written with the committed changes.
import { formerRules, isEmptyRules, mapWith, rulesIn, type LaneRules } from '../../model/document/lanemap';
import type { GeneratedJson, MapJson, SceneJson } from '../../model/document/scene-json';
import type { MotionSet } from '../../model/document/futures';
import type { Committed } from '../../model/document/history';
import { castKeyOfJson } from '../../model/document/scene-reader';
import { sceneKey, type Scene } from '../../model/document/scene';
import { castJson, generatedJson, timedJson, variantSample, writeScene } from '../../model/document/scene-writer';
import type { SignalStates } from '../../model/physics/signal-phases';
import type { SceneRef } from '../../net/generator';
import type { Session } from './session';

interface VariantTake {
  readonly id: number;
  readonly scene: Scene;
  readonly set: MotionSet;
}

/** A committed document in its written form, independent of later changes. */
export interface Snapshot {
  readonly committed: Committed;
  readonly map: MapJson | null;
  /** With the futures of the document; the map by its hash where the server has it. */
  body(): SceneJson;
  /** The same with the map inside: for files, and for servers without the map. */
  complete(): SceneJson;
}

export class SceneFile {
  /** As read from the server; null while no scene is open. */
  raw: SceneJson | null = null;
  map: MapJson | null = null;
  /** Hash of the map on the server; the list of scenes, which has it, may arrive after the scene. */
  mapHash: () => string | null = () => null;
  /** Does the server hold a scene under this id? */
  stored = false;
  /** Variants whose motions are stored with the scene. */
  variantTakes: () => readonly VariantTake[] = () => [];
  #withConditions = new Set<string>();
  /** Road users, recordings and signals of the version that the server holds. */
  #castKey: string | null = null;
  #drive = '';
  #signals = '';
  #rules = '';
  #whole: { readonly of: MapJson; readonly rules: LaneRules; readonly map: MapJson } | null = null;
  /** The server may hold another map than the hash names: rules of its lanes have changed. */
  #hasRules = false;

  constructor(private readonly session: Session) {}

  adopt(json: SceneJson, map: MapJson, stored: boolean): void {
    this.raw = json;
    this.map = map;
    this.mapHash = () => null;
    this.#hasRules = !isEmptyRules(formerRules(json));
    this.stored = stored;
    this.noteStored(json, map);
  }

  /** The map of a request: its hash where the server has it, else the whole map. */
  sentMap({ laneRules }: Scene): SceneJson['map'] {
    this.#hasRules ||= !isEmptyRules(laneRules);
    const hash = this.#hasRules ? null : this.mapHash();
    return hash ? { ref: hash } : this.wholeMap(laneRules)!;
  }

  /** The map with the rules of a document; null while no scene is open. */
  wholeMap(rules: LaneRules): MapJson | null {
    const { raw, map } = this;
    if (!raw || !map) return null;
    if (this.#whole?.of !== map || this.#whole.rules !== rules)
      this.#whole = { of: map, rules, map: mapWith(mapWith(map, formerRules(raw)), rules) };
    return this.#whole.map;
  }

  /** Does the server hold a scene of these road users, recordings and signals under the id of this one? */
  holds(scene: Scene): boolean {
    if (!this.stored || this.#castKey !== scene.castKey || this.#drive !== scene.drive) return false;
    return this.#signals === statesOf(scene.signals) && this.#rules === JSON.stringify(scene.laneRules);
  }

  /**
   * The server holds this version: remembers its road users, and those with conditions; released ones are sent as free.
   */
  noteStored(json: SceneJson, map = json.map): void {
    this.#castKey = castKeyOfJson(json);
    this.#drive = json.x_editor?.drive ?? '';
    this.#signals = statesOf(json.signals ?? []);
    this.#rules = JSON.stringify(rulesIn(map, formerRules(json)));
    const asked = json.agents.filter((a) => a.conditions && Object.keys(a.conditions).length);
    this.#withConditions = new Set(asked.map((a) => a.id));
  }

  /** The scene of a request about its motions: by name where the server holds it, else with its road users. */
  reference(scene: Scene): SceneRef {
    if (this.holds(scene)) return { id: scene.id };
    const raw = this.raw!;
    const of = { agents: castJson(scene), map: this.sentMap(scene), ...timedJson(raw, scene) };
    return { scene: { ...raw, ...of, generated: null } };
  }

  hadConditions(id: string): boolean {
    return this.#withConditions.has(id);
  }

  /** The committed document now; null while no scene is open. */
  snapshot(): Snapshot | null {
    const committed = this.session.document.committed.peek();
    const { raw } = this;
    if (!committed || !raw) return null;
    const { scene } = committed;
    const map = this.wholeMap(scene.laneRules);
    const generated = this.answers();
    const takes = generated ? this.variantTakes() : [];
    let written: SceneJson | null = null;
    const body = (): SceneJson =>
      (written ??= withVariants(writeScene(raw, scene, generated, this.sentMap(scene)), takes));
    return { committed, map, body, complete: () => (map ? { ...body(), map } : body()) };
  }

  /** The futures of the committed document; null while they are unknown, and where there are none. */
  answers(): GeneratedJson | null {
    const scene = this.session.document.scene.peek();
    const set = this.session.answers.motion.peek();
    return scene && set.key === sceneKey(scene) ? answersIn(scene, set) : null;
  }

  /** A document as a file of its own, with the map inside. */
  completeOf(scene: Scene, set: MotionSet): SceneJson | null {
    const map = this.wholeMap(scene.laneRules);
    return this.raw && writeScene(this.raw, scene, answersIn(scene, set), map ?? undefined);
  }

  /** The committed document as a file, with the map inside. */
  complete(): SceneJson | null {
    return this.snapshot()?.complete() ?? null;
  }
}

type WithStates = readonly { readonly states: SignalStates }[];

const written = new WeakMap<WithStates, string>();

/** States of signals as text: equal texts, equal states. */
function statesOf(signals: WithStates): string {
  let text = written.get(signals);
  if (text === undefined) written.set(signals, (text = JSON.stringify(signals.map((s) => s.states))));
  return text;
}

/** Kept variants are written with the motions of all their road users: another generator may not reproduce them. */
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
