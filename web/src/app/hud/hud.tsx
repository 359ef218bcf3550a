// Everything that floats over the picture: rail, layers, status, scale, zoom, hint, toast, banner, hover card.
import { Fragment } from 'preact';
import { useComputed } from '@preact/signals';
import { typeOfKind } from '../../model/base/kinds';
import { placedBy } from '../../actions/place';
import { actionOf } from '../../actions/registry';
import { TOOLS } from '../../edit/gestures/tools';
import type { Spread } from '../../edit/placing';
import { MenuButton } from '../menu';
import { useApp } from '../parts/app-context';
import { ActionButton, KeyCaps } from '../parts/buttons';
import { Later } from '../later';
import { Banner } from './banner';
import { Compass } from './compass';
import { HoverCard } from './hover-card';
import { Status } from './status';
import { ScaleBar, ZoomBar } from './view';
import { LoupeWords } from './loupe-words';
import { Thumb } from './thumb';
import { Toast } from './toast';
import { WayBack } from './way-back';
import { lengthUnit } from '../../model/base/units';
import { TEXTS } from '../../texts/desk/hud';

/** Those that are switched most; all are in the menu beside them. */
const LAYERS = ['futures', 'log', 'lanes', 'labels'] as const;

export function Hud() {
  const c = useApp();
  const { editor, form, ui } = c;
  const shift = ui.drawer.value ? 'shift' : '';
  const filling = useComputed(() => editor.filling.wish.value !== null).value;
  const coached = useComputed(() => ui.coach.value > 0).value;
  const placing = useComputed(() => {
    const kind = placedBy(c);
    return kind && editor.placement.choice(kind).spread;
  }).value;
  return (
    <div class="hud">
      {form.small.value ? <Thumb /> : <Rail />}
      <LoupeWords />
      <div class="tr">
        <div class="card chipbar" role="group" aria-label={TEXTS.layers}>
          {LAYERS.map((l) => (
            <ActionButton key={l} id={`layer-${l}`} icon="check" size={14} />
          ))}
          <MenuButton name="layers" icon="layers" label={TEXTS.allLayers} />
        </div>
      </div>
      <div class={`bl ${shift}`}>
        <div class="card status">
          <Status />
        </div>
        <ScaleBar />
      </div>
      {editor.dragging.value ? <DragHelp /> : placing ? <PlaceHelp spread={placing} /> : <ZoomBar />}
      <Compass />
      {placing ? <Later part="place" /> : null}
      {filling ? <Later part="fill" /> : null}
      <Later part="empty scene" />
      <WayBack />
      {coached ? <Later part="hint" /> : null}
      <Toast />
      <Banner />
      <HoverCard />
    </div>
  );
}

function Rail() {
  return (
    <nav class="rail" data-group="tools" aria-label={TEXTS.tools}>
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
    ['Alt', TEXTS.noSnapping],
    ['Shift', TEXTS.alongTheLane],
  ],
  heading: [
    ['Shift', TEXTS.at15Steps],
    ['Alt', 'fine'],
  ],
  speed: [
    ['Shift', TEXTS.at10KmHSteps],
    ['Alt', 'fine'],
  ],
  time: [['Shift', TEXTS.wholeSeconds]],
  via: [['Alt', TEXTS.noSnapping]],
  get ring() {
    return [['Shift', lengthUnit() === 'ft' ? TEXTS.wholeFeet : TEXTS.halfMetres]] as const;
  },
} as const;

const AT_KERB = [
  ['Alt', 'passes'],
  ['Shift', TEXTS.alongTheLane],
] as const;

const SEVERAL = {
  body: [
    ['Shift', TEXTS.oneDirection],
    ['Ctrl', TEXTS.goalsToo],
  ],
  heading: [
    ['Shift', TEXTS.at15Steps],
    ['Alt', TEXTS.eachAboutItself],
  ],
} as const;

const PLACING: Record<Spread, readonly (readonly [string, string])[]> = {
  one: [
    ['[', TEXTS.turnLeft],
    [']', TEXTS.turnRight],
    ['Alt', TEXTS.noSnapping],
    ['Esc', TEXTS.doneWithin],
  ],
  line: [['Esc', TEXTS.doneWithin]],
  area: [['Esc', TEXTS.doneWithin]],
};
const PLACING_WORDS: Record<Spread, string> = {
  one: TEXTS.clickToPlace,
  line: TEXTS.dragALineToPlace,
  area: TEXTS.dragOverTheGround,
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
  const answers = ['H', shown ? TEXTS.hideTheOthers : TEXTS.showTheOthers] as const;
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
          ? TEXTS.theFlagLagsBehind
          : several
            ? TEXTS.othersReactWhen
            : !react
              ? TEXTS.letGoToWorkIt
              : shown
                ? TEXTS.dashedBoxesWhere
                : TEXTS.othersReactWhen}
      </span>
      <div class="sep" />
      {[...tips, ['Esc', TEXTS.putBack]].map(([key, text]) => (
        <span key={key}>
          <KeyCaps of={key} />
          {text}
        </span>
      ))}
    </div>
  );
}
