// The panel on the right: the events when they are asked for, else the selected road user, else the scene.
import { useComputed } from '@preact/signals';
import { useApp } from '../parts/app-context';
import { Later } from '../parts/later';
import { AgentPanel } from './agent-panel';
import { EventsPanel } from './events-panel';
import { ScenePanel } from './scene-panel';
import { SeveralPanel } from './several-panel';

const layoutPanel = () => import('../layouts/panel').then((m) => m.default);
const roundsPanel = () => import('../rounds/panel').then((m) => m.default);
const comparePanel = () => import('../variants/compare-panel').then((m) => m.default);

export function Inspector() {
  const { editor, rounds, ui, variants } = useApp();
  const making = editor.layouts.isOpen.value;
  const judging = rounds.isOpen.value;
  const comparing = useComputed(() => variants.compared.value !== null).value;
  const events = useComputed(() => ui.eventsPanel.value && editor.events.value.length > 0).value;
  const scene = useComputed(() => editor.scene.value?.id).value;
  const selected = editor.selection.value;
  const several = useComputed(() => editor.selected.value.length > 1).value;
  return (
    <aside class="insp" aria-label="Inspector" data-group="inspector">
      {making ? (
        <Later key="layout" load={layoutPanel} />
      ) : comparing ? (
        <Later key="compare" load={comparePanel} />
      ) : judging ? (
        <Later key="rounds" load={roundsPanel} />
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
