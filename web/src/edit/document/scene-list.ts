// The list of scenes on the server.
import { signal, type ReadonlySignal } from '@preact/signals-core';
import type { Client } from '../../net/client';
import { keep, recall } from '../../net/storage';
import type { SceneListItem } from '../../net/types';
import { TEXTS } from '../../texts/scene/reading';

/** Examples in the order in which they are best met, last first. */
const FIRST = ['demo-motorway', 'demo-arterial', 'demo-residential', 'demo-roundabout', 'demo-crossing'];

export const isExample = (id: string): boolean => id.startsWith('demo-');

/** Road users of all types together. */
export const countAll = (counts: SceneListItem['counts']): number =>
  Object.values(counts).reduce((sum, n) => sum + n, 0);

/** So many scenes are remembered as opened last. */
const MOST_RECENT = 12;
const RECENT = 'recent';

export class SceneList {
  readonly #list = signal<readonly SceneListItem[]>([]);
  readonly #listed = signal(false);
  readonly #recent = signal<readonly string[]>(recall<string[]>(RECENT) ?? []);

  readonly list: ReadonlySignal<readonly SceneListItem[]> = this.#list;
  /** Has the server been asked yet? */
  readonly listed: ReadonlySignal<boolean> = this.#listed;

  /** Ids of the scenes opened last, the newest first. */
  readonly recent: ReadonlySignal<readonly string[]> = this.#recent;

  constructor(private readonly client: Client) {}

  noteOpened(id: string): void {
    this.#recent.value = [id, ...this.#recent.peek().filter((other) => other !== id)].slice(0, MOST_RECENT);
    keep(RECENT, this.#recent.peek());
  }

  async refresh(): Promise<void> {
    try {
      this.#list.value = inOrder(
        (await this.client.scenes()).scenes.map((s) => ({ ...s, name: TEXTS.sceneName(s.id, s.name) })),
      );
    } finally {
      this.#listed.value = true;
    }
  }

  find(id: string): SceneListItem | undefined {
    return this.#list.peek().find((s) => s.id === id);
  }

  isOwn(id: string): boolean {
    return !isExample(id) && !this.find(id)?.readonly;
  }
}

/** Own scenes first, newest on top, then the examples, then what was recorded. */
function inOrder(scenes: readonly SceneListItem[]): SceneListItem[] {
  const rank = (s: SceneListItem): number => (isExample(s.id) ? 1 : !s.readonly ? 0 : 2);
  const example = (s: SceneListItem): number => (isExample(s.id) ? -FIRST.indexOf(s.id) : 0);
  return [...scenes].sort((a, b) => rank(a) - rank(b) || example(a) - example(b));
}
