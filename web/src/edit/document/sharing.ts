// Links with a scene inside: what a link contains, and how one is opened.
import { signal, type ReadonlySignal } from '@preact/signals-core';
import { isMapRef, type SceneJson } from '../../model/document/scene-json';
import { Away, Refused, type Client } from '../../net/client';
import type { Library } from './library';
import type { SceneCare } from './scene-care';
import type { SceneFile } from './scene-file';
import type { Session } from './session';
import type { ShownAt } from './share-link';
import { isShareLink } from './share-mark';
import type { SharedParts } from './shared-parts';
import { TEXTS } from '../../texts/editing/keeping';

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
    const [{ MOST_LINK_BYTES, writeLink }, { reduced }] = await Promise.all([
      import('./share-link'),
      import('./shared-parts'),
    ]);
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
