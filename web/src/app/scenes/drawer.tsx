// List of scenes with search, dates and pictures; files can be dropped here.
import { useEffect, useRef } from 'preact/hooks';
import { useComputed, useSignal } from '@preact/signals';
import { perform } from '../../actions/registry';
import type { SceneListItem } from '../../net/types';
import { isRecorded } from '../../model/document/scene';
import { countAll, isExample } from '../../edit/document/scene-list';
import { useApp } from '../parts/app-context';
import { ActionButton, IconButton } from '../parts/buttons';
import { DrawerTabs } from '../parts/drawer-tabs';
import { Icon } from '../parts/icons';
import { dayAndTime } from './dates';
import { Thumbnail } from './thumbnail';
import { TEXTS } from '../../texts/desk/scenes';

/** A list longer than this has a search, and recently opened ones first. */
const MANY = 8,
  MOST_RECENT = 3;

export function Drawer() {
  const { form, scenes } = useApp();
  const input = useRef<HTMLInputElement>(null);
  const query = useSignal('');
  const wanted = query.value.trim().toLowerCase().split(/\s+/);
  const words = (s: SceneListItem): string => `${s.name} ${s.source ?? ''} ${s.id} ${about(s)}`.toLowerCase();
  return (
    <section class="drawer card" aria-label={TEXTS.scenes} data-group="scenes">
      <DrawerTabs />
      <h2 class="sr">{TEXTS.scenes}</h2>
      {scenes.list.value.length > MANY ? (
        <label class="field search">
          <Icon name="search" size={14} />
          <input
            ref={input}
            type="search"
            placeholder={TEXTS.findAScene}
            aria-label={TEXTS.findAScene}
            onInput={() => {
              query.value = input.current!.value;
            }}
            onKeyDown={(e) => {
              if (e.key === 'Escape') input.current!.blur();
            }}
          />
        </label>
      ) : null}
      <div class="scns">
        <List items={scenes.list.value.filter((s) => wanted.every((w) => words(s).includes(w)))} />
      </div>
      <div class="ways">
        <ActionButton id="new-map" class="line" size={15} />
        <ActionButton id="choose-files" class="line" size={15} />
      </div>
      {form.touch.value ? null : <p class="mut dropnote">{TEXTS.dropSceneFiles}</p>}
    </section>
  );
}

/** Not the registry's button: within a sentence it is a plain link. */
export function ChooseFiles() {
  const c = useApp();
  return (
    <>
      <button type="button" onClick={() => c.chooseFiles()}>
        {TEXTS.chooseFiles}
      </button>
      {' · '}
      <button type="button" data-action="choose-files" onClick={() => perform(c, 'choose-files')}>
        {TEXTS.supportedFormats}
      </button>
    </>
  );
}

function List({ items }: { items: readonly SceneListItem[] }) {
  const { scenes } = useApp();
  if (!items.length) return <p class="mut drop">{scenes.listed.value ? TEXTS.noSceneOfThat : TEXTS.loading}</p>;
  const recent =
    items.length > MANY
      ? scenes.recent.value.flatMap((id) => items.find((s) => s.id === id) ?? []).slice(0, MOST_RECENT)
      : [];
  const rest = items.filter((s) => !recent.includes(s));
  const parts: [string, readonly SceneListItem[]][] = [
    [TEXTS.recent, recent],
    [TEXTS.mine, rest.filter((s) => !s.readonly && !isExample(s.id))],
    [TEXTS.examples, rest.filter((s) => isExample(s.id))],
    [TEXTS.recorded, rest.filter((s) => s.readonly && !isExample(s.id))],
  ];
  return (
    <div>
      {parts
        .filter(([, part]) => part.length)
        .map(([name, part]) => (
          <section key={name} aria-label={name}>
            <h3>{name}</h3>
            {part.map((s) => (
              <Item key={`${s.id}:${s.etag ?? ''}`} item={s} />
            ))}
          </section>
        ))}
    </div>
  );
}

function Item({ item }: { item: SceneListItem }) {
  const { editor, library, ui } = useApp();
  const current = useComputed(() => editor.resting.value?.id === item.id).value;
  const aimed = useComputed(() => ui.aimed.value === item.id).value;
  const name = useComputed(() => (editor.resting.value?.id === item.id ? editor.resting.value.name : item.name));
  if (ui.renaming.value === item.id) return <NewName item={item} />;
  return (
    <div
      class="scnrow"
      onPointerEnter={() => ui.aimAt(item.id)}
      onPointerLeave={() => ui.aimAt(null)}
      onFocusCapture={() => ui.aimAt(item.id)}
    >
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
          {item.updated_at && !item.readonly ? <small>{dayAndTime(item.updated_at)}</small> : null}
        </div>
      </button>
      {aimed ? (
        <span class="does">
          <IconButton id="rename-scene" size={14} />
          <IconButton id="duplicate-scene" size={14} />
          <IconButton id="delete-scene" size={14} />
        </span>
      ) : null}
    </div>
  );
}

function NewName({ item }: { item: SceneListItem }) {
  const { care, ui } = useApp();
  const input = useRef<HTMLInputElement>(null);
  useEffect(() => {
    input.current!.focus();
    input.current!.select();
  }, []);
  const done = (keep: boolean) => {
    if (ui.renaming.peek() !== item.id) return;
    const typed = input.current!.value.trim();
    ui.renameScene(null);
    if (keep && typed && typed !== item.name) void care.rename(item.id, typed);
  };
  return (
    <div class="scnrow">
      <label class="field rename">
        <input
          ref={input}
          type="text"
          aria-label={TEXTS.newName}
          maxlength={80}
          value={item.name}
          onBlur={() => done(true)}
          onKeyDown={(e) => {
            if (e.key === 'Enter') done(true);
            if (e.key !== 'Escape') return;
            e.stopPropagation();
            done(false);
          }}
        />
      </label>
    </div>
  );
}

/** `29 road users · example`; a stored scene has its owner, where scenes have owners. */
export function about(s: SceneListItem): string {
  const n = countAll(s.counts);
  const kind =
    s.source && isRecorded(s.source) ? TEXTS.recordedWithin : s.readonly ? TEXTS.example : (s.owner ?? TEXTS.own);
  return [n ? TEXTS.roadUsers(n) : TEXTS.noRoadUsers, kind].join(' · ');
}
