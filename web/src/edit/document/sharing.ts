// Links with a scene inside: what a link contains, and how one is opened.
import { signal, type ReadonlySignal } from '@preact/signals-core';
import type { Feedback } from '../../model/document/feedback';
import { isMapRef, type EditorJson, type SceneJson } from '../../model/document/scene-json';
import { Away, Refused, type Client } from '../../net/client';
import type { Library } from './library';
import type { SceneCare } from './scene-care';
import type { SceneFile } from './scene-file';
import type { Session } from './session';
import type { ShownAt } from './share-link';
import { isShareLink } from './share-mark';
import { TEXTS } from '../../texts/editing/keeping';

/** Parts of a scene that a link contains. */
export interface SharedParts {
  /** Goals, and the followed future of each. */
  readonly futures: boolean;
  /** Texts by users: name, tags, notes. */
  readonly words: boolean;
  /** The shown time and place. */
  readonly start: boolean;
}

export interface Link {
  /** Null where the link would be too long. */
  readonly url: string | null;
  readonly bytes: number;
}

export class Sharing {
  readonly #error = signal<string | null>(null);
  /** Why a link could not be opened. */
  readonly error: ReadonlySignal<string | null> = this.#error;

  constructor(
    private readonly session: Session,
    private readonly file: SceneFile,
    private readonly library: Library,
    private readonly care: SceneCare,
    private readonly client: Client,
    /** Shows a time and place of an opened scene. */
    private readonly show: (at: ShownAt) => void,
  ) {}

  dismiss(): void {
    this.#error.value = null;
  }

  async link(parts: SharedParts, at: ShownAt): Promise<Link> {
    const whole = this.file.complete();
    if (!whole) return { url: null, bytes: 0 };
    const { MOST_LINK_BYTES, writeLink } = await import('./share-link');
    const { hash, bytes } = await writeLink({ scene: reduced(whole, parts), at: parts.start ? at : null });
    const fits = bytes <= MOST_LINK_BYTES;
    return { url: fits ? location.origin + location.pathname + hash : null, bytes };
  }

  /** Opens the scene of a link read-only; no stored scene is replaced. False where the link has none. */
  async openFrom(hash: string): Promise<boolean> {
    if (!isShareLink(hash)) return false;
    this.#error.value = null;
    const [{ LinkError, readLink }, { tryImport }] = await Promise.all([
      import('./share-link'),
      import('../../net/imports'),
    ]);
    try {
      const { scene, at } = await readLink(hash);
      // The server reads it like a file, with the same limits.
      const reply = await tryImport(this.client, scene);
      const read = reply.scenes[0]?.scene as SceneJson | undefined;
      if (!read || isMapRef(read.map)) throw new LinkError(TEXTS.thereIsNoWhole);
      const copy = (): void => void this.#copy(read.name ?? TEXTS.sharedScene);
      await this.library.show(read, {
        words: TEXTS.thisSceneCame,
        label: TEXTS.makeACopy,
        run: copy,
      });
      if (at) this.show(at);
      return true;
    } catch (e) {
      if (e instanceof Away) throw e;
      if (!(e instanceof LinkError) && !(e instanceof Refused)) throw e;
      this.#error.value = e.message;
      return false;
    }
  }

  /** From now on it is an own scene. */
  async #copy(name: string): Promise<void> {
    await this.care.saveAs(name);
    if (this.session.document.lock.peek() === null) history.replaceState(null, '', location.pathname + location.search);
  }
}

/** The scene without the parts that stay out of the link; of six futures only the followed one. */
export function reduced(scene: SceneJson, parts: SharedParts): SceneJson {
  const { generated } = scene;
  const sample = generated?.samples[generated.chosen_sample ?? 0];
  const followed =
    parts.futures && generated && sample
      ? {
          ...generated,
          chosen_sample: 0,
          samples: [
            {
              agents: Object.fromEntries(
                Object.entries(sample.agents).map(([id, f]) => [id, { ...f, chosen: 0, modes: [f.modes[f.chosen]] }]),
              ),
            },
          ],
        }
      : null;
  const { picked, variants, feedback, pins, scene_feedback: whole } = scene.x_editor ?? {};
  const one = picked && Object.fromEntries(Object.keys(picked).map((id) => [id, 0]));
  return {
    ...scene,
    id: undefined,
    ...(parts.words ? {} : { name: TEXTS.sharedScene, meta: { ...scene.meta, tags: [], notes: '' } }),
    agents: parts.futures ? scene.agents : scene.agents.map((a) => ({ ...a, conditions: {} })),
    x_editor: {
      ...scene.x_editor,
      picked: parts.futures ? one : undefined,
      pins: parts.futures ? (parts.words ? pins : unnamedPins(pins)) : undefined,
      feedback: parts.futures ? (parts.words ? feedback : unnamed(feedback)) : undefined,
      scene_feedback: parts.futures && whole ? (parts.words ? whole : withoutNames(whole)) : undefined,
      // Their motion is computed again when they are shown.
      variants: parts.futures ? variants?.map((v) => ({ ...v, name: parts.words ? v.name : undefined })) : undefined,
    },
    generated: followed,
  };
}

/** Feedback on futures without their names. */
const withoutNames = (f: Feedback): Feedback => ({ ...f, answers: f.answers.map((a) => ({ ...a, name: '' })) });
const unnamed = (all: EditorJson['feedback']): EditorJson['feedback'] =>
  all && Object.fromEntries(Object.entries(all).map(([id, f]) => [id, withoutNames(f)]));
const unnamedPins = (all: EditorJson['pins']): EditorJson['pins'] =>
  all && Object.fromEntries(Object.entries(all).map(([id, list]) => [id, list.map((p) => ({ ...p, name: '' }))]));
