// Top bar: menu, lists, scene name and saving, undo, generate, actions, share, export.
import { useRef } from 'preact/hooks';
import { useComputed } from '@preact/signals';
import { rename } from '../model/document/commands';
import { isRecorded } from '../model/document/scene';
import type { SaveState } from '../edit/document/saving';
import { MenuButton, OpenMenu } from './menu';
import { useApp } from './parts/app-context';
import { ActionButton, IconButton } from './parts/buttons';
import { TEXTS } from '../texts/desk/page';

const SAVED: Record<SaveState, string> = {
  example: TEXTS.example,
  saved: TEXTS.saved,
  saving: TEXTS.saving,
  local: TEXTS.savedOnThisComputer,
  conflict: TEXTS.changedElsewhere,
  full: TEXTS.noRoomToSave,
  off: TEXTS.notSaved,
};

/** Texts that alternate during work: space for the widest is reserved, so that neighbours do not move. */
const USUAL = [TEXTS.example, TEXTS.saved, TEXTS.saving, TEXTS.dragging].reduce((a, b) =>
  b.length > a.length ? b : a,
);

export function TopBar() {
  const { editor, form } = useApp();
  const open = useComputed(() => editor.resting.value !== null).value;
  if (form.small.value) return <SmallBar open={open} />;
  return (
    <header class="top" data-group="top">
      <Logo />
      <MenuButton name="file" icon="menu" label={TEXTS.fileAndSettings} />
      <DrawerButton />
      <Title />
      {open ? (
        <>
          <div class="sep" />
          <IconButton id="undo" />
          <IconButton id="redo" />
        </>
      ) : null}
      <div class="grow" />
      {open ? <Generate /> : null}
      <div class="grow" />
      {open ? (
        <>
          <ActionButton id="palette" withKey size={16}>
            <span class="mut">{TEXTS.actions}</span>
          </ActionButton>
          <ActionButton id="share" size={16} />
          <ActionButton id="export" class="line" size={16} />
        </>
      ) : null}
      <OpenMenu />
    </header>
  );
}

/** Opens the lists of the drawer, the one of scenes first; closes the one that is open. */
function DrawerButton() {
  const { ui } = useApp();
  const id = ui.drawer.value ?? 'scenes';
  return <IconButton key={id} id={id} icon="list" />;
}

/** Generate, and beside it the menu of its options. */
function Generate() {
  const { editor, form } = useApp();
  const away = useComputed(() => editor.answers.away.value !== null).value;
  return (
    <div class="split">
      <ActionButton id="generate" class="pri" icon="" withKey={!form.sheet.value}>
        {away ? TEXTS.waiting : undefined}
      </ActionButton>
      <MenuButton name="generate" icon="down" label={TEXTS.generateOptions} class="pri" />
    </div>
  );
}

/** Undo, share and the menus; the menus contain everything else. */
function SmallBar({ open }: { open: boolean }) {
  return (
    <header class="top" data-group="top">
      <MenuButton name="file" icon="menu" label={TEXTS.fileAndSettings} />
      <Title />
      <div class="grow" />
      {open ? (
        <>
          <IconButton id="undo" />
          <IconButton id="share" />
        </>
      ) : null}
      <MenuButton name="more" icon="more" label={TEXTS.more} />
      <OpenMenu />
    </header>
  );
}

function Logo() {
  return (
    <div class="logo" aria-hidden="true">
      <svg viewBox="0 0 18 18" width={18} height={18}>
        <path d="M4 15C4 9 5 7 13 5M13 5l-3-2.200M13 5l-2 3.200" />
        <circle cx={4} cy={15} r={1.3} fill="currentColor" />
      </svg>
    </div>
  );
}

function Title() {
  const { editor, saving, layouts } = useApp();
  const id = useComputed(() => editor.resting.value?.id).value;
  const name = useComputed(() => (editor.resting.value ? TEXTS.dragtraffic(editor.resting.value.name) : 'DragTraffic'));
  const state = useComputed(() => {
    const scene = editor.resting.value;
    if (layouts.isNew.value) return TEXTS.notSaved;
    if (editor.drag.active.value) return TEXTS.dragging;
    if (!scene) return '';
    if (editor.document.lock.value) return TEXTS.readOnly;
    const saved = saving.state.value;
    return saved === 'example' && isRecorded(scene.source) ? TEXTS.recordedScene : SAVED[saved];
  });
  return (
    <div class="title">
      <h1 class="sr">{name}</h1>
      {layouts.isNew.value ? (
        <b>{TEXTS.newMap}</b>
      ) : id === undefined ? (
        <span>DragTraffic</span>
      ) : (
        <NameField key={id} />
      )}
      <small title={state} data-room={USUAL}>
        {state}
      </small>
    </div>
  );
}

function NameField() {
  const { editor } = useApp();
  const input = useRef<HTMLInputElement>(null);
  const name = useComputed(() => editor.resting.value?.name ?? '');
  // Width of the name in characters: capitals are wider than most, so one is subtracted.
  const size = useComputed(() => Math.max(4, name.value.length - 1));
  return (
    <input
      ref={input}
      type="text"
      aria-label={TEXTS.nameOfTheScene}
      maxlength={80}
      spellcheck={false}
      value={name}
      size={size}
      onChange={() => {
        const typed = input.current!.value.trim();
        if (typed && typed !== name.peek()) editor.commits.run(rename(typed));
      }}
      onKeyDown={(e) => {
        if (e.key === 'Enter') input.current!.blur();
        if (e.key !== 'Escape') return;
        input.current!.value = name.peek();
        input.current!.blur();
        e.stopPropagation();
      }}
    />
  );
}
