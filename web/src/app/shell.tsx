// The page that Preact renders around and over the canvases. The canvases themselves belong to the stage.
import { render, type ComponentChild } from 'preact';
import { useComputed } from '@preact/signals';
import type { Context } from '../actions/context';
import { HandleSliders } from './access/handle-sliders';
import { LiveRegion } from './access/live-region';
import { RoadUsers } from './access/road-users';
import { Dialogs } from './dialogs/dialogs';
import { Hud } from './hud/hud';
import { Inspector } from './inspector/inspector';
import { fetchRest, Later } from './later';
import { place } from './outline';
import { AppProvider, useApp } from './parts/app-context';
import { Sheet } from './sheet/sheet';
import { Timeline } from './timeline/timeline';
import { TopBar } from './topbar';

/** Renders the page around and over the stage's element. */
export function drawPage(c: Context): void {
  const picture = c.stage.element;
  const [over, below] = [place(), place()];
  picture.append(over);
  picture.after(below);
  const draw = (what: ComponentChild, into: HTMLElement) => render(<AppProvider value={c}>{what}</AppProvider>, into);
  draw(<TopBar />, c.bar);
  draw(<OverPicture />, over);
  draw(<Around />, below);
  fetchRest();
}

function OverPicture() {
  const { editor, scenes, ui, layouts } = useApp();
  const making = layouts.isOpen.value;
  const nothing = useComputed(() => editor.resting.value === null && scenes.listed.value).value;
  const drawer = useComputed(() => (editor.resting.value && !layouts.isOpen.value ? ui.drawer.value : null)).value;
  return (
    <>
      {nothing && !making ? <Later part="empty" /> : null}
      <RoadUsers />
      <HandleSliders />
      <Hud />
      {making ? <Later part="templates" /> : null}
      {drawer === 'scenes' ? <Later part="scenes" /> : null}
      {drawer === 'history' ? <Later part="history" /> : null}
    </>
  );
}

function Around() {
  const { editor, form, rounds, ui, variants } = useApp();
  const menu = useComputed(() => ui.contextMenu.value !== null).value;
  const judging = rounds.isOpen.value;
  const comparing = useComputed(() => variants.comparing.compared.value !== null).value;
  const strip = useComputed(() => variants.open.value && editor.isOpen.value).value;
  return (
    <>
      {judging ? <Later key="rounds" part="round cards" /> : strip ? <Later key="variants" part="variants" /> : null}
      {comparing ? <Later part="compare view" /> : null}
      {form.sheet.value ? (
        <Sheet />
      ) : (
        <>
          <Inspector />
          <Timeline />
        </>
      )}
      <Dialogs />
      {menu ? <Later part="context menu" /> : null}
      <LiveRegion />
    </>
  );
}
