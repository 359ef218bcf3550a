// The page: what Preact draws around the canvases and over them. The canvases themselves are the stage's.
import { render, type ComponentChild } from 'preact';
import { useComputed } from '@preact/signals';
import type { Context } from '../actions/context';
import { HandleSliders } from './access/handle-sliders';
import { LiveRegion } from './access/live-region';
import { RoadUsers } from './access/road-users';
import { ContextMenu } from './context-menu';
import { Dialogs } from './dialogs/dialogs';
import { HistoryPanel } from './history/panel';
import { Hud } from './hud/hud';
import { Inspector } from './inspector/inspector';
import { AppProvider, useApp } from './parts/app-context';
import { Later } from './parts/later';
import { Drawer } from './scenes/drawer';
import { Empty } from './scenes/empty';
import { Sheet } from './sheet/sheet';
import { Timeline } from './timeline/timeline';
import { TopBar } from './topbar';

/** A place for components that takes no part in the layout. */
function mount(parent: Element): HTMLElement {
  const el = document.createElement('div');
  el.className = 'swap';
  parent.append(el);
  return el;
}

/** Puts the page into `root`, around and over the stage's element. */
export function drawPage(c: Context, root: HTMLElement): void {
  const top = mount(root);
  root.append(c.stage.element);
  const over = mount(c.stage.element);
  const below = mount(root);
  const draw = (what: ComponentChild, into: HTMLElement) => render(<AppProvider value={c}>{what}</AppProvider>, into);
  draw(<TopBar />, top);
  draw(<OverPicture />, over);
  draw(<Around />, below);
}

function OverPicture() {
  const { editor, ui } = useApp();
  const making = editor.layouts.isOpen.value;
  const drawer = useComputed(() => (editor.scene.value && !editor.layouts.isOpen.value ? ui.drawer.value : null)).value;
  return (
    <>
      {making ? null : <Empty />}
      <RoadUsers />
      <HandleSliders />
      <Hud />
      {making ? <Later load={templates} /> : null}
      {drawer === 'scenes' ? <Drawer /> : null}
      {drawer === 'history' ? <HistoryPanel /> : null}
    </>
  );
}

const templates = () => import('./layouts/templates').then((m) => m.default);
const compareView = () => import('./variants/compare-view').then((m) => m.default);
const roundStrip = () => import('./rounds/strip').then((m) => m.default);
const variantStrip = () => import('./variants/strip').then((m) => m.default);

function Around() {
  const { editor, form, rounds, variants } = useApp();
  const judging = rounds.isOpen.value;
  const comparing = useComputed(() => variants.compared.value !== null).value;
  const strip = useComputed(() => variants.open.value && editor.isOpen.value).value;
  return (
    <>
      {judging ? <Later key="rounds" load={roundStrip} /> : strip ? <Later key="variants" load={variantStrip} /> : null}
      {comparing ? <Later load={compareView} /> : null}
      {form.sheet.value ? (
        <Sheet />
      ) : (
        <>
          <Inspector />
          <Timeline />
        </>
      )}
      <Dialogs />
      <ContextMenu />
      <LiveRegion />
    </>
  );
}
