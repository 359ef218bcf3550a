// Start-up: opens and shows the first scene while the workspace (`desk.ts`) loads.
import '../styles/tokens.css';
import '../styles/base.css';
import '../styles/panels.css';
import '../styles/sheet.css';
import '../styles/touch.css';
import { effect } from '@preact/signals-core';
import type { Context, Opening } from '../actions/context';
import { Form } from '../actions/form';
import { Ui } from '../actions/ui';
import { Editor } from '../edit/session/editor';
import { Journal } from '../edit/document/journal';
import { Library } from '../edit/document/library';
import { Picture } from '../edit/overlay/picture';
import { Saving } from '../edit/document/saving';
import { SceneFile } from '../edit/document/scene-file';
import { SceneList } from '../edit/document/scene-list';
import { Stage } from '../draw/stage';
import { Client } from '../net/client';
import { BrowserStepStore, PassingStepStore } from '../net/step-store';
import { recall } from '../net/storage';
import { TEXTS } from '../texts/desk/page';
import { LANGUAGE } from '../texts/language';
import { followForm, insetBesideSheet } from './frame';
import { lookAtOpened, lookWhereItWas } from './look';
import { sayIncomplete } from './incomplete';
import { outlineOfBar, place } from './outline';
import { reportCrashes, waitForServer } from './watching';

const FIRST_SCENE = 'demo-crossing';
/** On a narrower page the list of scenes is closed at first. */
const WIDE_PX = 1300;
/** Covered edges of the picture, in pixels; on the left by the open panel. */
const INSET = { right: 12, top: 12, bottom: 56 };
const INSET_LEFT = { scenes: 324, map: 348, users: 368, history: 432, rail: 68 };
/** Seconds that play automatically at the very first visit. */
const INTRODUCTION_S = 3;

function makeOpening(): Opening {
  const ui = new Ui();
  const form = new Form();
  // The stage reads the colours from the page when it is made.
  document.documentElement.dataset.theme = ui.theme.peek();
  document.documentElement.lang = LANGUAGE;
  const client = new Client();
  const editor = new Editor();
  const scenes = new SceneList(client);
  const file = new SceneFile(editor);
  const journal = new Journal(typeof indexedDB === 'undefined' ? new PassingStepStore() : new BrowserStepStore());
  const saving = new Saving(editor.document, file, scenes, client, journal);
  const library = new Library(editor, file, saving, scenes, client, journal);
  const main = document.createElement('main');
  main.className = 'stage';
  main.setAttribute('aria-label', TEXTS.trafficScene);
  main.setAttribute('aria-busy', 'true');
  const stage = new Stage(main);
  const picture = new Picture(stage, editor);
  const bar = place(outlineOfBar(form.small.peek()));
  return { ui, form, client, editor, scenes, file, journal, saving, library, stage, picture, bar };
}

/** Links between parts. */
function connect(o: Opening): void {
  const { editor, form, library, stage, ui } = o;
  ui.showDrawer(innerWidth >= WIDE_PX ? 'scenes' : null);
  lookWhereItWas(o);
  effect(() => {
    stage.element.classList.toggle('bare', editor.resting.value === null && !editor.view.mapDraft.isOpen.value);
  });
  effect(() => {
    document.documentElement.dataset.theme = ui.theme.value;
    stage.themeChanged();
  });
  effect(() => {
    const drawer = editor.view.mapDraft.isOpen.value ? 'map' : ui.drawer.value;
    const left = INSET_LEFT[drawer ?? 'rail'];
    const before = stage.view.copy();
    stage.view.inset = form.sheet.value ? insetBesideSheet(o, INSET, INSET_LEFT.rail) : { ...INSET, left };
    if (stage.view.inset.bottom > before.inset.bottom) stage.covered.emit(before);
    stage.element.dataset.drawer = drawer ?? '';
  });
  effect(() => followForm(o));
  library.opened.listen((scene, again) => {
    nameInAddress(o, scene.id);
    if (!again) {
      // An empty scene has suggestions over the picture, and an open sheet would leave no room for them.
      if (!scene.agents.size) form.open('peek');
      stage.view.turn = 0;
      lookAtOpened(o);
    }
    ui.showEvents(false);
  });
  void document.fonts?.ready.then(() => stage.invalidate('agents', 'overlay'));
}

/** A reloaded page opens its own scene, whatever other tabs have opened since. */
function nameInAddress({ scenes }: Opening, id: string): void {
  if (!scenes.list.peek().some((s) => s.id === id)) return;
  const address = new URL(location.href);
  address.searchParams.set('scene', id);
  history.replaceState(null, '', address);
}

async function openFirst(o: Opening, desk: Promise<Context>): Promise<void> {
  const wanted = new URLSearchParams(location.search).get('scene') ?? recall<string>('last-scene');
  try {
    await o.scenes.refresh();
    // The address may contain a scene, or name a run, which the workspace reads.
    if (location.hash && (await (await desk).openFrom(location.hash))) return;
    const ids = o.scenes.list.peek().map((s) => s.id);
    const id = [wanted, FIRST_SCENE, ids[0]].find((i) => i && ids.includes(i));
    if (!id) return o.editor.answers.report({ kind: 'ready' });
    await o.library.open(id);
  } catch {
    waitForServer(o);
  }
}

const opening = makeOpening();
document.getElementById('app')!.append(opening.bar, opening.stage.element);
connect(opening);
reportCrashes(opening);
const desk = import('./desk').then(
  ({ layOut }) => layOut(opening),
  () => sayIncomplete(opening.stage.element),
);
void openFirst(opening, desk).then(async () => {
  if (opening.ui.coach.peek() && opening.editor.scene.peek()) (await desk).playback.introduce(INTRODUCTION_S);
});
