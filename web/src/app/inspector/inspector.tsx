// The right panel: the events if requested, else the selected road user, else the scene.
import { useComputed } from '@preact/signals';
import { useApp } from '../parts/app-context';
import { Later } from '../later';
import { ScenePanel } from './scene-panel';
import { TEXTS } from '../../texts/panels/inspector';

export function Inspector() {
  const { editor, rounds, searching, ui, variants, layouts } = useApp();
  const making = layouts.isOpen.value;
  const judging = rounds.isOpen.value;
  const cases = searching.open.value !== null;
  const comparing = useComputed(() => variants.comparing.compared.value !== null).value;
  const events = useComputed(() => {
    const open = ui.eventsPanel.value;
    // It stays open after a change of thresholds, even if no event remains.
    const changed = Object.keys(editor.resting.value?.thresholds ?? {}).length > 0;
    return open === 'counts' || (open && (changed || editor.reading.events.value.length > 0));
  }).value;
  const scene = useComputed(() => editor.resting.value?.id).value;
  const selected = editor.selection.value;
  const item = useComputed(() => editor.mapItem.value !== null).value;
  const several = useComputed(() => editor.selected.value.length > 1).value;
  return (
    <aside class="insp" aria-label={TEXTS.inspector} data-group="inspector">
      {making ? (
        <Later key="layout" part="layout" />
      ) : comparing ? (
        <Later key="compare" part="compare" />
      ) : judging ? (
        <Later key="rounds" part="rounds" />
      ) : cases ? (
        <Later key="cases" part="cases" />
      ) : events ? (
        <Later key="events" part="events" />
      ) : several ? (
        <Later key="several" part="several" />
      ) : selected ? (
        <Later key={`agent:${selected}`} part="agent" id={selected} />
      ) : item ? (
        <Later key="map item" part="map item" />
      ) : (
        <ScenePanel key={`scene:${scene}`} />
      )}
    </aside>
  );
}
