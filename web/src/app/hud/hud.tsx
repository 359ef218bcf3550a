// Everything that floats over the picture: rail, layers, status, scale, zoom, hint, toast, banner, hover card.
import { useComputed } from '@preact/signals';
import { actionOf } from '../../actions/registry';
import { TOOLS } from '../../edit/gestures/tools';
import { useApp } from '../parts/app-context';
import { ActionButton, KeyCaps } from '../parts/buttons';
import { Banner } from './banner';
import { Coach, Toast } from './messages';
import { HoverCard } from './hover-card';
import { Status } from './status';
import { ScaleBar, ZoomBar } from './view';
import { WayBack } from './way-back';

const LAYERS = ['futures', 'log', 'lanes', 'labels'] as const;

export function Hud() {
  const { editor, ui } = useApp();
  const shift = ui.drawer.value ? 'shift' : '';
  return (
    <div class="hud">
      <Rail />
      <div class="tr">
        <div class="card chipbar" role="group" aria-label="Layers">
          {LAYERS.map((l) => (
            <ActionButton key={l} id={`layer-${l}`} icon="check" size={14} />
          ))}
        </div>
      </div>
      <div class={`bl ${shift}`}>
        <div class="card status">
          <Status />
        </div>
        <ScaleBar />
      </div>
      {editor.dragging.value ? <DragHelp /> : <ZoomBar />}
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
      {TOOLS.map(({ name }) => (
        <ActionButton key={name} id={`tool-${name}`} size={20}>
          <em>{actionOf(`tool-${name}`).keys![0]}</em>
        </ActionButton>
      ))}
    </nav>
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
} as const;

const AT_KERB = [
  ['Alt', 'passes'],
  ['Shift', 'along the lane'],
] as const;

function DragHelp() {
  const { editor } = useApp();
  const handle = useComputed(() => editor.drag.value?.grip.handle ?? 'body').value;
  const shown = editor.showForeseen.value;
  const react = editor.scene.peek()?.others === 'react';
  const held = useComputed(() => !!editor.drag.value?.lag).value;
  const answers = ['H', `${shown ? 'hide' : 'show'} the others’ answers`] as const;
  const tips = held ? AT_KERB : react ? [...TIPS[handle].slice(0, 1), answers] : TIPS[handle];
  return (
    <div class="card helpbar">
      <span class="mut">
        {held
          ? 'The flag lags behind while a kerb is in the way'
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
