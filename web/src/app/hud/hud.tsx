// Everything that floats over the picture: rail, layers, status, scale, zoom, hint, toast, banner, hover card.
import { Fragment } from 'preact';
import { useComputed } from '@preact/signals';
import { typeOfKind } from '../../model/kinds';
import { placedBy } from '../../actions/place';
import { actionOf } from '../../actions/registry';
import { TOOLS } from '../../edit/gestures/tools';
import type { Spread } from '../../edit/placing';
import { MenuButton } from '../menu';
import { useApp } from '../parts/app-context';
import { ActionButton, KeyCaps } from '../parts/buttons';
import { Later } from '../later';
import { Banner } from './banner';
import { Coach, Toast } from './messages';
import { HoverCard } from './hover-card';
import { Status } from './status';
import { ScaleBar, ZoomBar } from './view';
import { LoupeWords } from './loupe-words';
import { Thumb } from './thumb';
import { WayBack } from './way-back';

/** Those that are switched most; all are in the menu beside them. */
const LAYERS = ['futures', 'log', 'lanes', 'labels'] as const;

export function Hud() {
  const c = useApp();
  const { editor, form, ui } = c;
  const shift = ui.drawer.value ? 'shift' : '';
  const filling = useComputed(() => editor.filling.wish.value !== null).value;
  const placing = useComputed(() => {
    const kind = placedBy(c);
    return kind && editor.placement.choice(kind).spread;
  }).value;
  return (
    <div class="hud">
      {form.small.value ? <Thumb /> : <Rail />}
      <LoupeWords />
      <div class="tr">
        <div class="card chipbar" role="group" aria-label="Layers">
          {LAYERS.map((l) => (
            <ActionButton key={l} id={`layer-${l}`} icon="check" size={14} />
          ))}
          <MenuButton name="layers" icon="layers" label="All layers" />
        </div>
      </div>
      <div class={`bl ${shift}`}>
        <div class="card status">
          <Status />
        </div>
        <ScaleBar />
      </div>
      {editor.dragging.value ? <DragHelp /> : placing ? <PlaceHelp spread={placing} /> : <ZoomBar />}
      {placing ? <Later part="place" /> : null}
      {filling ? <Later part="fill" /> : null}
      <Later part="empty scene" />
      <WayBack />
      <Coach />
      <Toast />
      <Banner />
      <HoverCard />
    </div>
  );
}

function Rail() {
  return (
    <nav class="rail" aria-label="Tools">
      {TOOLS.map((tool, i) => (
        <Fragment key={tool.name}>
          {i && 'places' in tool !== 'places' in TOOLS[i - 1] ? <hr /> : null}
          <Tool id={`tool-${tool.name}`} class={'places' in tool ? `t-${typeOfKind(tool.places)}` : ''} />
        </Fragment>
      ))}
    </nav>
  );
}

function Tool({ id, class: className }: { id: string; class?: string }) {
  return (
    <ActionButton id={id} size={20} class={className} iconOnly>
      <em data-key={actionOf(id).keys![0]} aria-hidden="true" />
    </ActionButton>
  );
}

/** What the modifier keys do to each handle. */
const TIPS = {
  body: [
    ['Alt', 'no snapping'],
    ['Shift', 'along the lane'],
  ],
  heading: [
    ['Shift', '15° steps'],
    ['Alt', 'fine'],
  ],
  speed: [
    ['Shift', '10 km/h steps'],
    ['Alt', 'fine'],
  ],
  time: [['Shift', 'whole seconds']],
  via: [['Alt', 'no snapping']],
  ring: [['Shift', 'half metres']],
} as const;

const AT_KERB = [
  ['Alt', 'passes'],
  ['Shift', 'along the lane'],
] as const;

const SEVERAL = {
  body: [
    ['Shift', 'one direction'],
    ['Ctrl', 'goals too'],
  ],
  heading: [
    ['Shift', '15° steps'],
    ['Alt', 'each about itself'],
  ],
} as const;

const PLACING: Record<Spread, readonly (readonly [string, string])[]> = {
  one: [
    ['[', 'turn left'],
    [']', 'turn right'],
    ['Alt', 'no snapping'],
    ['Esc', 'done'],
  ],
  line: [['Esc', 'done']],
  area: [['Esc', 'done']],
};
const PLACING_WORDS: Record<Spread, string> = {
  one: 'Click to place, drag to set the heading',
  line: 'Drag a line to place them along it',
  area: 'Drag over the ground to spread them',
};

function PlaceHelp({ spread }: { spread: Spread }) {
  return (
    <div class="card helpbar">
      <span class="mut">{PLACING_WORDS[spread]}</span>
      <div class="sep" />
      {PLACING[spread].map(([key, text]) => (
        <span key={key}>
          <KeyCaps of={key} />
          {text}
        </span>
      ))}
    </div>
  );
}

function DragHelp() {
  const { editor } = useApp();
  const several = editor.selected.peek().length > 1;
  const handle = useComputed(() => editor.drag.value?.grip.handle ?? 'body').value;
  const shown = editor.showForeseen.value;
  const react = editor.scene.peek()?.others === 'react';
  const held = useComputed(() => !!editor.drag.value?.lag).value;
  const answers = ['H', `${shown ? 'hide' : 'show'} the others’ answers`] as const;
  const tips = several
    ? SEVERAL[handle === 'heading' ? 'heading' : 'body']
    : held
      ? AT_KERB
      : react
        ? [...TIPS[handle].slice(0, 1), answers]
        : TIPS[handle];
  return (
    <div class="card helpbar">
      <span class="mut">
        {held
          ? 'The flag lags behind while a kerb is in the way'
          : several
            ? 'Others react when you let go'
            : !react
              ? 'Let go to work it out'
              : shown
                ? 'Dashed boxes: where they would wait'
                : 'Others react when you let go'}
      </span>
      <div class="sep" />
      {[...tips, ['Esc', 'put back']].map(([key, text]) => (
        <span key={key}>
          <KeyCaps of={key} />
          {text}
        </span>
      ))}
    </div>
  );
}
