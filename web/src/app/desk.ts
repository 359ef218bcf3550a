// Everything one works with: tools, panels, the generator, and what of them follows from what.
import { effect } from '@preact/signals-core';
import type { Context, Opening } from '../actions/context';
import { perform } from '../actions/registry';
import { Searching } from '../edit/cases/searching';
import { Copying } from '../edit/copying';
import { Filler } from '../edit/filler';
import { LayoutMaker } from '../edit/layout-maker';
import { Generation } from '../edit/generation';
import { Gestures } from '../edit/gestures/pointer';
import { Importing } from '../edit/importing';
import { Overlay } from '../edit/overlay';
import { Playback } from '../edit/playback';
import { SceneCare } from '../edit/document/scene-care';
import { Sharing } from '../edit/document/sharing';
import { Questions } from '../edit/question';
import { Rounds } from '../edit/rounds/rounds';
import { Supposing } from '../edit/supposing';
import { Trial } from '../edit/trial';
import { Maker } from '../edit/variants/making';
import { Variants } from '../edit/variants/variants';
import { FarLine } from '../net/far-line';
import { HttpGenerator } from '../net/http-generator';
import { clipboardOf, listenToClipboard } from './clipboard';
import { fileChooser } from './file-chooser';
import { focusAgent, focusField, focusGroup, focusName, focusText } from './focus';
import { followView, gliding } from './hud/view-tick';
import { fitScene, followSelected, keepInView, lookAtMade, lookAtOpened, openMenu, reveal } from './look';
import { listenToPage } from './page-input';
import { keepInSight } from './sheet/in-sight';
import { drawPage } from './shell';
import { coach } from './watching';

function makeParts(o: Opening): Context {
  const { client, editor, file, journal, library, picture, saving, scenes, stage } = o;
  const line = new FarLine(client);
  const generator = (): HttpGenerator => new HttpGenerator(client, line.ask);
  const care = new SceneCare(editor, file, library, scenes, client, journal);
  const importing = new Importing(editor, library, scenes, client);
  const generation = new Generation(editor, file, saving, generator(), generator());
  const overlay = new Overlay(
    editor,
    (a) => picture.poseNow(a),
    () => picture.taken,
  );
  stage.painter('overlay', (g, v) => {
    overlay.paint(g, v);
    if (overlay.moving) stage.invalidate('overlay');
  });
  const varied = generator();
  const maker = new Maker(editor, new Questions(editor, file), varied, file);
  const variants = new Variants(editor, maker, () => varied.cancel());
  file.variantTakes = () => [...new Set([...variants.within('kept'), ...variants.within('starred')])];
  const searched = generator();
  const searcher = new Maker(editor, new Questions(editor, file), searched, file);
  const tried = new Supposing(editor, new Questions(editor, file), generator(), file);
  const c: Context = {
    ...o,
    care,
    importing,
    generation,
    variants,
    searching: new Searching(editor, searcher, () => searched.cancel()),
    sharing: new Sharing(editor, file, library, care, client),
    gestures: new Gestures(stage, editor, picture, overlay, generation),
    playback: new Playback(editor, stage),
    maker: new LayoutMaker(editor, file, care, client),
    rounds: new Rounds(editor, new Questions(editor, file), generator()),
    trial: new Trial(editor, tried),
    supposing: new Supposing(editor, new Questions(editor, file), generator(), file),
    copying: new Copying(editor),
    filler: new Filler(editor, file, client),
    clipboard: clipboardOf(() => c),
    reveal: (ids) => reveal(c, ids),
    focusText,
    openMenu: () => openMenu(c),
    chooseFiles: fileChooser((files) => void importing.files(files)),
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
  const { editor, gestures, generation, library, playback, sharing, stage, supposing, trial, ui, variants } = c;
  followView(stage);
  lookAtMade(c);
  keepInView(c);
  keepInSight(c);
  stage.onFrame = (now) => {
    gestures.frame(now);
    playback.frame(now);
    followSelected(c);
  };
  // For screen readers, and for scripts that drive the page: what is on screen is not the last word yet.
  effect(() => {
    const asked =
      generation.busy.value ||
      editor.filling.asking.value ||
      editor.layouts.asking.value ||
      variants.busy.value ||
      editor.deck.asking.value ||
      trial.asking.value ||
      supposing.asking.value;
    const busy = asked || editor.status.value.kind === 'loading' || gliding.value || editor.calm.waiting.value;
    stage.element.setAttribute('aria-busy', String(busy));
  });
  gestures.onTap = (fingers) => perform(c, fingers === 2 ? 'undo' : 'redo');
  gestures.onMenu = (at, on, future) => ui.openContextMenu({ ...at, on, future });
  sharing.onOpened = (at) => {
    if (!at) return;
    stage.view.look(at.camera);
    stage.viewChanged();
    editor.setTime(at.time);
  };
  addEventListener('hashchange', () => void sharing.openFrom(location.hash));
  library.askBy((missing) => {
    // Events of the log; with changes from last time the answer to them brings its own.
    if (!editor.motion.peek().stale) void generation.score();
    if (missing !== 'none') generation.opened(missing === 'everybody');
  });
  stage.viewChanged();
}

/** Puts everything around the picture that is there already. */
export function layOut(o: Opening): Context {
  const c = makeParts(o);
  connect(c);
  drawPage(c);
  listenToPage(c);
  listenToClipboard(c);
  coach(c);
  return c;
}
