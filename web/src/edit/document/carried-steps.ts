// The steps of a scene that was saved as another one: undo and redo go on in the copy.
import type { KeptHistory, ReadonlyHistory } from '../../model/document/history';
import { stateOf } from '../../model/document/scene-diff';
import type { KeptScene, StepStore } from '../../net/step-store';

type CarriedSteps = Pick<KeptScene, 'steps' | 'base'> & { readonly at: Omit<KeptHistory, 'steps'> };

/** The steps up to now, for a copy under this name: a copy keeps its name when earlier names are undone. */
export function carriedSteps(history: ReadonlyHistory, name: string): CarriedSteps | null {
  const { steps, ...at } = history.kept();
  if (!steps.length) return null;
  const nameless = <T extends object>(fields: T): T =>
    Object.fromEntries(Object.entries(fields).filter(([key]) => key !== 'name')) as T;
  return {
    at,
    base: stateOf({ ...history.first(), name }),
    steps: steps.map((s) => ({
      ...s,
      diff: { ...s.diff, back: nameless(s.diff.back), forth: nameless(s.diff.forth) },
    })),
  };
}

/** Stores them for the new scene, which the server has in the current document. Without storage it begins anew. */
export function carrySteps(
  store: StepStore,
  scene: string,
  { at, ...kept }: CarriedSteps,
  etag: string,
): Promise<void> {
  const synced = { etag, step: at.head, revision: at.revision };
  return store.rewrite({ ...kept, place: { ...at, scene, synced, at: Date.now() } }).catch(() => undefined);
}
