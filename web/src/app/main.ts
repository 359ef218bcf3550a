// Start-up: makes the parts, draws the page, opens the first scene.
import '../styles/tokens.css';
import '../styles/base.css';
import '../styles/panels.css';
import '../styles/sheet.css';
import '../styles/touch.css';
import { effect } from '@preact/signals-core';
import type { Context } from '../actions/context';
import { perform } from '../actions/registry';
import { Form } from '../actions/form';
import { Ui } from '../actions/ui';
import { Copying } from '../edit/copying';
import { Editor } from '../edit/editor';
import { Filler } from '../edit/filler';
import { LayoutMaker } from '../edit/layout-maker';
import { Generation } from '../edit/generation';
import { Journal } from '../edit/journal';
import { Gestures } from '../edit/gestures/pointer';
import { Importing } from '../edit/importing';
import { Library } from '../edit/library';
import { Picture } from '../edit/picture';
import { Playback } from '../edit/playback';
import { Saving } from '../edit/saving';
import { SceneCare } from '../edit/scene-care';
import { SceneFile } from '../edit/scene-file';
import { SceneList } from '../edit/scene-list';
import { Sharing } from '../edit/sharing';
import { Questions } from '../edit/question';
import { Rounds } from '../edit/rounds/rounds';
import { Trial } from '../edit/trial';
import { Maker } from '../edit/variants/making';
import { Variants } from '../edit/variants/variants';
import { Stage } from '../draw/stage';
import { Client } from '../net/client';
import { HttpGenerator } from '../net/http-generator';
import { BrowserStepStore, PassingStepStore } from '../net/step-store';
import { recall } from '../net/storage';
import { clipboardOf, listenToClipboard } from './clipboard';
import { fileChooser } from './file-chooser';
import { focusAgent, focusField, focusGroup, focusName, focusText } from './focus';
import { followView, gliding } from './hud/view-tick';
import { fitScene, followSelected, lookAtMade, lookAtOpened, lookWhereItWas, openMenu, reveal } from './look';
import { listenToPage } from './page-input';
import { drawPage } from './shell';
import { coach, reportCrashes, waitForServer } from './watching';

const FIRST_SCENE = 'demo-crossing';
/** On a page narrower than this the list of scenes is closed at first. */
const WIDE_PX = 1300;
/** What panels cover of the picture's edges, in pixels; on the left by what stands there. */
const INSET = { right: 12, top: 12, bottom: 56 };
const INSET_LEFT = { scenes: 324, map: 348, users: 368, history: 432, rail: 68 };
/** How wide a sheet at the side is. */
const SIDE_SHEET_PX = 352;
/** How wide the loupe is, where there is room and where there is little. */
const LOUPE_PX = 156;
const LOUPE_SMALL_PX = 124;
/** Handles for fingers are so much larger. */
const HANDLES_FOR_FINGERS = 1.7;
/** Seconds that play by themselves at the very first visit. */
const INTRODUCTION_S = 3;

function makeParts(): Context {
  const ui = new Ui();
  const form = new Form();
  // Colours are read off the page when the stage is made.
  document.documentElement.dataset.theme = ui.theme.peek();
  const client = new Client();
  const editor = new Editor();
  const scenes = new SceneList(client);
  const file = new SceneFile(editor);
  const journal = new Journal(typeof indexedDB === 'undefined' ? new PassingStepStore() : new BrowserStepStore());
  const saving = new Saving(editor, file, scenes, client, journal);
  const library = new Library(editor, file, saving, scenes, client, journal);
  const care = new SceneCare(editor, file, library, scenes, client, journal);
  const sharing = new Sharing(editor, file, library, care, client);
  const importing = new Importing(editor, library, scenes, client);
  const generation = new Generation(editor, file, saving, new HttpGenerator(client), new HttpGenerator(client));
  const main = document.createElement('main');
  main.className = 'stage';
  main.setAttribute('aria-label', 'Traffic scene');
  const stage = new Stage(main);
  const picture = new Picture(stage, editor);
  const gestures = new Gestures(stage, editor, picture, generation);
  const playback = new Playback(editor, stage);
  const chooseFiles = fileChooser((files) => void importing.files(files));
  const line = new HttpGenerator(client);
  const maker = new Maker(editor, new Questions(editor, file), line, file);
  const variants = new Variants(editor, maker, () => line.cancel());
  file.variantTakes = () => [...new Set([...variants.within('kept'), ...variants.within('starred')])];
  const rounds = new Rounds(editor, new Questions(editor, file), new HttpGenerator(client));
  const trial = new Trial(editor, new Questions(editor, file), new HttpGenerator(client));
  const copying = new Copying(editor);
  const filler = new Filler(editor, file, client);
  const parts = {
    maker: new LayoutMaker(editor, file, care, client),
    copying,
    editor,
    filler,
    variants,
    rounds,
    trial,
    generation,
    scenes,
    library,
    care,
    sharing,
    journal,
    file,
    saving,
    importing,
    playback,
    gestures,
    picture,
  };
  const c: Context = {
    ...parts,
    stage,
    client,
    ui,
    form,
    clipboard: clipboardOf(() => c),
    reveal: (ids) => reveal(c, ids),
    focusText,
    openMenu: () => openMenu(c),
    chooseFiles,
    focusField,
    focusGroup,
    focusAgent,
    focusName,
    fit: () => fitScene(c),
    lookAtScene: () => lookAtOpened(c),
  };
  return c;
}

/** What one part does when another changes. */
function connect(c: Context): void {
  const { editor, form, gestures, generation, library, playback, sharing, stage, trial, ui, variants } = c;
  ui.showDrawer(innerWidth >= WIDE_PX ? 'scenes' : null);
  followView(stage);
  lookWhereItWas(c);
  lookAtMade(c);
  stage.onFrame = (now) => {
    gestures.frame(now);
    playback.frame(now);
    followSelected(c);
  };
  effect(() => {
    stage.element.classList.toggle('bare', editor.scene.value === null && !editor.layouts.isOpen.value);
  });
  // For screen readers, and for scripts that drive the page: what is on screen is not the last word yet.
  effect(() => {
    const asked =
      generation.busy.value ||
      editor.filling.asking.value ||
      editor.layouts.asking.value ||
      variants.busy.value ||
      editor.deck.asking.value ||
      trial.asking.value;
    const busy = asked || editor.status.value.kind === 'loading' || gliding.value;
    stage.element.setAttribute('aria-busy', String(busy));
  });
  effect(() => {
    document.documentElement.dataset.theme = ui.theme.value;
    stage.themeChanged();
  });
  effect(() => {
    const drawer = editor.layouts.isOpen.value ? 'map' : ui.drawer.value;
    stage.view.inset = form.sheet.value ? insetBesideSheet(c) : { ...INSET, left: INSET_LEFT[drawer ?? 'rail'] };
    stage.element.dataset.drawer = drawer ?? '';
  });
  effect(() => followForm(c));
  gestures.onTap = (fingers) => perform(c, fingers === 2 ? 'undo' : 'redo');
  gestures.onMenu = (at, on) => ui.openContextMenu({ ...at, on });
  sharing.onOpened = (at) => {
    if (!at) return;
    Object.assign(stage.view, at.camera);
    stage.viewChanged();
    editor.setTime(at.time);
  };
  addEventListener('hashchange', () => void sharing.openFrom(location.hash));
  library.onOpen = (scene, again) => {
    nameInAddress(c, scene.id);
    if (!again) lookAtOpened(c);
    ui.showEvents(false);
    // Events of the log; with changes from last time the answer to them brings its own.
    if (!editor.motion.peek().stale) void generation.score();
  };
  void document.fonts?.ready.then(() => stage.invalidate('agents', 'overlay'));
}

/** What the sheet leaves of the picture. */
function insetBesideSheet({ form }: Context): { left: number; right: number; top: number; bottom: number } {
  const left = form.small.value ? 12 : INSET_LEFT.rail;
  if (form.low.value) return { ...INSET, left, right: SIDE_SHEET_PX, bottom: 12 };
  // A sheet that is fully open covers nearly everything; the picture stays where it was.
  return { ...INSET, left, bottom: form.pixels(form.height.value === 'peek' ? 'peek' : 'half') + 12 };
}

/** The page is laid out by attributes of its root. */
function followForm({ form, stage, ui }: Context): void {
  const root = document.documentElement.dataset;
  root.form = form.sheet.value ? (form.low.value ? 'side-sheet' : 'sheet') : 'panels';
  for (const [name, on] of [
    ['touch', form.touch.value],
    ['small', form.small.value],
    ['tall', ui.tall.value],
  ] as const)
    if (on) root[name] = '';
    else delete root[name];
  stage.view.grip = form.touch.value ? HANDLES_FOR_FINGERS : 1;
  stage.loupePx = form.small.value ? LOUPE_SMALL_PX : LOUPE_PX;
  document.documentElement.style.setProperty('--loupe', `${stage.loupePx}px`);
  stage.invalidate('overlay');
}

/** A page that is loaded again opens what it showed, whatever other tabs have opened since. */
function nameInAddress({ scenes }: Context, id: string): void {
  if (!scenes.list.peek().some((s) => s.id === id)) return;
  const address = new URL(location.href);
  address.searchParams.set('scene', id);
  history.replaceState(null, '', address);
}

async function openFirst(c: Context): Promise<void> {
  const wanted = new URLSearchParams(location.search).get('scene') ?? recall<string>('last-scene');
  try {
    await c.scenes.refresh();
    if (await c.sharing.openFrom(location.hash)) return;
    const ids = c.scenes.list.peek().map((s) => s.id);
    const id = [wanted, FIRST_SCENE, ids[0]].find((i) => i && ids.includes(i));
    if (!id) return c.editor.answers.report({ kind: 'ready' });
    await c.library.open(id);
    if (c.ui.coach.peek() && c.editor.scene.peek()) c.playback.introduce(INTRODUCTION_S);
  } catch {
    waitForServer(c);
  }
}

const c = makeParts();
connect(c);
drawPage(c, document.getElementById('app')!);
reportCrashes(c);
listenToPage(c);
listenToClipboard(c);
coach(c);
void openFirst(c);
