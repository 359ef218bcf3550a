// A map with nobody on it: what one can do about that.
import { useComputed } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { actionOf, perform } from '../../actions/registry';
import { HELPS } from '../../texts/desk/helps';
import { useApp } from '../parts/app-context';
import { KeyCaps } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { TEXTS } from '../../texts/desk/empty';

const WAYS = ['place-first', 'tool-fill', 'import-log'] as const;

export function EmptyScene() {
  const { editor, ui } = useApp();
  const scene = useComputed(() => editor.resting.value?.id ?? null).value;
  const nobody = useComputed(() => editor.resting.value?.agents.size === 0).value;
  // Once somebody was here the card does not come back.
  useEffect(() => {
    if (scene !== null && !nobody) ui.hideEmpty(scene);
  }, [scene, nobody, ui]);
  const shown = useComputed(
    () =>
      editor.tool.value === 'select' &&
      editor.resting.value !== null &&
      ui.emptyHidden.value !== editor.resting.value.id,
  ).value;
  return nobody && shown && !editor.layouts.isOpen.value ? <Card scene={scene!} /> : null;
}

function Card({ scene }: { scene: string }) {
  const c = useApp();
  return (
    <section class={`card nobody ${c.ui.drawer.value ? 'shift' : ''}`} aria-label={TEXTS.nobodyIsHere}>
      <button type="button" class="btn i" aria-label={TEXTS.close} onClick={() => c.ui.hideEmpty(scene)}>
        <Icon name="x" size={16} />
      </button>
      <h2>{c.editor.scene.peek()!.map.lanes.size ? TEXTS.theMapIsInNobody : TEXTS.plainGroundNobody}</h2>
      <p>{TEXTS.startWithOne}</p>
      <div class="ways">
        {WAYS.map((id, i) => {
          const a = actionOf(id);
          return (
            <button key={id} type="button" class={i ? '' : 'first'} data-action={id} onClick={() => perform(c, id)}>
              <span class="ag t-ink">
                <Icon name={a.icon!} size={20} />
              </span>
              <KeyCaps of={a.keys![0]} />
              <b>{a.label}</b>
              <small>{HELPS[a.help]}</small>
            </button>
          );
        })}
      </div>
      <p class="mut">
        <button type="button" data-action="new-map" onClick={() => perform(c, 'new-map')}>
          {TEXTS.newMap}
        </button>{' '}
        <KeyCaps of="Shift+T" /> {TEXTS.insteadOfThis}
        <span class="everything">
          {' · '}
          <KeyCaps of="Ctrl+K" /> {TEXTS.forEverything}
        </span>
      </p>
    </section>
  );
}
