// All overlays of the picture: rail, layers, status, scale, zoom, hint, toast, banner, hover card.
import { useRef } from 'preact/hooks';
import { useComputed } from '@preact/signals';
import { typeOfKind } from '../../model/base/kinds';
import { placedBy } from '../../actions/place';
import { actionOf } from '../../actions/registry';
import { RAIL } from '../../edit/tools/tools';
import type { Spread } from '../../edit/moves/placing';
import { MenuButton } from '../menu';
import { useApp } from '../parts/app-context';
import { ActionButton, KeyCaps } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { Later } from '../later';
import { Banner } from './banner';
import { HoverCard } from './hover-card';
import { Status } from './status';
import { ScaleBar, ZoomBar } from './view';
import { viewTick } from './view-tick';
import { Toast } from './toast';
import { lengthUnit } from '../../model/base/units';
import { TEXTS } from '../../texts/desk/hud';

/** Tools that are always in the rail; the menu below has all others, and the active one of them joins these. */
const ALWAYS = ['select', 'pan'];

export function Hud() {
  const c = useApp();
  const { editor, form, ui, placement } = c;
  const shift = ui.drawer.value ? 'shift' : '';
  const driving = useComputed(() => c.driving.isOn.value).value;
  const following = useComputed(() => !!c.following.run.value?.isOn.value).value;
  const filling = useComputed(() => c.filling.wish.value !== null).value;
  const coached = useComputed(() => ui.coach.value > 0).value;
  const placing = useComputed(() => {
    const kind = placedBy(c);
    return kind && placement.choice(kind).spread;
  }).value;
  const isTurned = useComputed(() => (void viewTick.value, c.stage.view.turn !== 0)).value;
  /** A drag of the compass passes north, too: once shown, it decides itself. */
  const turned = useRef(false);
  turned.current ||= isTurned;
  return (
    <div class="hud">
      {form.small.value ? <Later part="thumb" /> : <Rail />}
      <div class="tr">
        <div class="card chipbar">
          <MenuButton name="layers" icon="down" label={TEXTS.allLayers}>
            <Icon name="layers" size={16} />
            {TEXTS.layers}
          </MenuButton>
        </div>
      </div>
      <div class={`bl ${shift}`}>
        <div class="card status">
          <Status />
        </div>
        <ScaleBar />
      </div>
      {driving ? (
        <Later part="drive" />
      ) : following ? (
        <Later part="follow" />
      ) : editor.drag.active.value ? (
        <DragHelp />
      ) : placing ? (
        <PlaceHelp spread={placing} />
      ) : (
        <ZoomBar />
      )}
      {turned.current ? <Later part="compass" /> : null}
      {placing ? <Later part="place" /> : null}
      {filling ? <Later part="fill" /> : null}
      <Later part="empty scene" />
      <Later part="way back" />
      {coached ? <Later part="hint" /> : null}
      <Toast />
      <Banner />
      <HoverCard />
    </div>
  );
}

function Rail() {
  const { editor } = useApp();
  const now = editor.tool.value;
  const other = RAIL.find((t) => t.name === now && !ALWAYS.includes(now));
  return (
    <nav class="rail" data-group="tools" aria-label={TEXTS.tools}>
      {ALWAYS.map((name) => (
        <Tool key={name} id={`tool-${name}`} />
      ))}
      <hr />
      {other ? <Tool id={`tool-${now}`} class={other.places ? `t-${typeOfKind(other.places)}` : ''} /> : null}
      <MenuButton name="add" icon="plus" label={TEXTS.addAndMore} />
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

/** Effect of the modifier keys on each handle. */
const TIPS = {
  body: [
    ['Alt', TEXTS.noSnapping],
    ['Shift', TEXTS.alongTheLane],
  ],
  heading: [
    ['Shift', TEXTS.at15Steps],
    ['Alt', TEXTS.fineSteps],
  ],
  speed: [
    ['Shift', TEXTS.at10KmHSteps],
    ['Alt', TEXTS.fineSteps],
  ],
  time: [['Shift', TEXTS.wholeSeconds]],
  via: [['Alt', TEXTS.noSnapping]],
  get ring() {
    return [['Shift', lengthUnit() === 'ft' ? TEXTS.wholeFeet : TEXTS.halfMetres]] as const;
  },
} as const;

const AT_KERB = [
  ['Alt', TEXTS.acrossTheKerb],
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
  const handle = useComputed(() => editor.drag.info.value?.grip.handle ?? 'body').value;
  const shown = editor.view.showPreviewed.value;
  const react = editor.scene.peek()?.others === 'react';
  const held = useComputed(() => !!editor.drag.info.value?.lag).value;
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
              ? TEXTS.releaseToCompute
              : shown
                ? TEXTS.dashedBoxesWhere
                : TEXTS.othersReactWhen}
      </span>
      <div class="sep" />
      {[...tips, ['Esc', TEXTS.cancel]].map(([key, text]) => (
        <span key={key}>
          <KeyCaps of={key} />
          {text}
        </span>
      ))}
    </div>
  );
}
