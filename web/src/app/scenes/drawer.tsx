// List of scenes with search and pictures; the place to drop files.
import { useRef } from 'preact/hooks';
import { useComputed, useSignal } from '@preact/signals';
import type { SceneListItem } from '../../net/types';
import { isRecorded } from '../../model/scene';
import { countAll } from '../../edit/scene-list';
import { useApp } from '../parts/app-context';
import { IconButton } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { Thumbnail } from './thumbnail';

export function Drawer() {
  const { scenes } = useApp();
  const input = useRef<HTMLInputElement>(null);
  const query = useSignal('');
  const wanted = query.value.trim().toLowerCase();
  const words = (s: SceneListItem): string => `${s.name} ${s.source ?? ''} ${s.id}`.toLowerCase();
  return (
    <section class="drawer card" aria-label="Scenes" data-group="scenes">
      <h2>
        Scenes
        <span class="grow" />
        <IconButton id="scenes" icon="x" size={16} />
      </h2>
      <label class="field search">
        <Icon name="search" size={14} />
        <input
          ref={input}
          type="search"
          placeholder="Find a scene"
          aria-label="Find a scene"
          onInput={() => {
            query.value = input.current!.value;
          }}
          onKeyDown={(e) => {
            if (e.key === 'Escape') input.current!.blur();
          }}
        />
      </label>
      <div class="scns">
        <List items={scenes.list.value.filter((s) => words(s).includes(wanted))} />
      </div>
      <div class="drop">
        <b>Drop scene files here</b>
        {'or '}
        <ChooseFiles />
      </div>
    </section>
  );
}

/** Not the registry's button: in a sentence it has no look of its own. */
export function ChooseFiles() {
  const c = useApp();
  return (
    <button type="button" data-action="choose-files" onClick={() => c.chooseFiles()}>
      choose files
    </button>
  );
}

function List({ items }: { items: readonly SceneListItem[] }) {
  const { scenes } = useApp();
  if (!items.length) return <p class="mut drop">{scenes.listed.value ? 'No scene of that name.' : 'Loading …'}</p>;
  return (
    <div>
      {items.map((s) => (
        <Item key={`${s.id}:${s.etag ?? ''}`} item={s} />
      ))}
    </div>
  );
}

function Item({ item }: { item: SceneListItem }) {
  const { editor, library } = useApp();
  const current = useComputed(() => editor.scene.value?.id === item.id).value;
  const name = useComputed(() => (editor.scene.value?.id === item.id ? editor.scene.value.name : item.name));
  return (
    <button
      type="button"
      class="scn"
      data-scene={item.id}
      aria-current={current}
      onClick={() => void library.open(item.id)}
    >
      <Thumbnail item={item} width={64} height={46} />
      <div class="who">
        <b title={item.name}>{name}</b>
        <small>{about(item)}</small>
      </div>
    </button>
  );
}

/** `29 road users · example` */
export function about(s: SceneListItem): string {
  const n = countAll(s.counts);
  const kind = s.source && isRecorded(s.source) ? 'recorded' : s.readonly ? 'example' : 'own';
  return [n ? `${n} road users` : '', kind].filter(Boolean).join(' · ');
}
