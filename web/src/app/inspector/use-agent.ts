// A road user in the current document, or shortly before in a drag. It changes only with its own drag: the others stay
// the same objects while the scene changes.
import { useComputed, type ReadonlySignal } from '@preact/signals';
import type { Agent, Scene } from '../../model/document/scene';
import { useApp } from '../parts/app-context';

export type LiveAgent = ReadonlySignal<Agent>;

/** The panel disappears with the road user; until then it shows the last state. `of` selects the document. */
export function useAgent(id: string, of?: () => ReadonlySignal<Scene | null>): LiveAgent {
  const { editor } = useApp();
  const first = editor.scene.peek()!.agents.get(id)!;
  return useComputed(() => editor.reading.throttle.read(() => (of?.() ?? editor.scene).value?.agents.get(id)) ?? first);
}
