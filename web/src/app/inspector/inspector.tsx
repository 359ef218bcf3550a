// The panel on the right: the events when they are asked for, else the selected road user, else the scene.
import { useComputed } from '@preact/signals';
import { useApp } from '../parts/app-context';
import { Later } from '../parts/later';
import { AgentPanel } from './agent-panel';
import { EventsPanel } from './events-panel';
import { ScenePanel } from './scene-panel';
import { SeveralPanel } from './several-panel';

const comparePanel = () => import('../variants/compare-panel').then((m) => m.default);

export function Inspector() {
  const { editor, ui, variants } = useApp();
  const comparing = useComputed(() => variants.compared.value !== null).value;
  const events = useComputed(() => ui.eventsPanel.value && editor.events.value.length > 0).value;
  const scene = useComputed(() => editor.scene.value?.id).value;
  const selected = editor.selection.value;
  const several = useComputed(() => editor.selected.value.length > 1).value;
  return (
    <aside class="insp" aria-label="Inspector" data-group="inspector">
      {comparing ? (
        <Later load={comparePanel} />
      ) : events ? (
        <EventsPanel />
      ) : several ? (
        <SeveralPanel />
      ) : selected ? (
        <AgentPanel key={`agent:${selected}`} id={selected} />
      ) : (
        <ScenePanel key={`scene:${scene}`} />
      )}
    </aside>
  );
}
