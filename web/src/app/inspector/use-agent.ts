// A road user as the document has it now, or in a drag had it a moment ago. It changes with the drag of one's own
// handles alone: the others stay the same objects while the scene around them changes.
import { useComputed, type ReadonlySignal } from '@preact/signals';
import type { Agent, Scene } from '../../model/document/scene';
import { useApp } from '../parts/app-context';

export type LiveAgent = ReadonlySignal<Agent>;

/** The panel goes when the road user does; until then it shows it as it last was. `of` says which document is meant. */
export function useAgent(id: string, of?: () => ReadonlySignal<Scene | null>): LiveAgent {
  const { editor } = useApp();
  const first = editor.scene.peek()!.agents.get(id)!;
  return useComputed(() => editor.reading.throttle.read(() => (of?.() ?? editor.scene).value?.agents.get(id)) ?? first);
}
