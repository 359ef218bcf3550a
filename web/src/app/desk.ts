// The workspace: tools, panels and generator, and the links between them.
import { effect } from '@preact/signals-core';
import type { Context, Opening } from '../actions/context';
import { perform } from '../actions/registry';
import { Generation } from '../edit/asking/generation';
import { Gestures } from '../edit/gestures/pointer';
import { Following } from '../edit/tools/following/following';
import { Importing } from '../edit/tools/importing/importing';
import { Overlay } from '../edit/overlay/overlay';
import { Playback } from '../edit/session/playback';
import { Ownership } from '../edit/document/ownership';
import { SceneCare } from '../edit/document/scene-care';
import { Sharing } from '../edit/document/sharing';
import { localReach } from '../model/words/reach-words';
import { RequestBuilder } from '../edit/asking/request-builder';
import { Placement } from '../edit/moves/placement';
import { makeTools } from '../edit/tools/tools';
import { WorkerTransport } from '../net/worker-transport';
import { HttpGenerator } from '../net/http-generator';
import { clipboardOf, listenToClipboard } from './clipboard';
import { fileChooser } from './file-chooser';
import { focusAgent, focusField, focusGroup, focusName, focusText } from './focus';
import { measureCards } from './hud/cards-over';
import { followView, gliding } from './hud/view-tick';
import { followDriven } from './follow-drive';
import { fitScene, followSelected, keepInView, lookAtMade, lookAtOpened, openMenu, reveal } from './look';
import { listenToPage } from './page-input';
import { keepInSight } from './sheet/in-sight';
import { drawPage } from './shell';
import { coach } from './coach-steps';

function makeParts(o: Opening): Context {
  const { client, editor, file, journal, library, picture, saving, scenes, stage } = o;
  const worker = new WorkerTransport(client);
  const generator = (): HttpGenerator => new HttpGenerator(client, worker.ask);
  const care = new SceneCare(editor, file, library, scenes, client, journal, saving);
  const importing = new Importing(editor, library, scenes, client);
  const questions = (): RequestBuilder => new RequestBuilder(editor, file);
  const placement = new Placement();
  const { made, named } = makeTools({ editor, file, care, client, placement, generator, questions });
  editor.reading.layReach(localReach);
  const takeUp = named.curve.takeUp.bind(named.curve);
  const generation = new Generation(editor, file, saving, generator(), generator(), takeUp);
  const overlays = made.flatMap(({ overlay }) => overlay ?? []);
  const overlay = new Overlay(
    editor,
    overlays,
    (a) => picture.poseNow(a),
    () => picture.taken,
    measureCards(stage),
  );
  stage.painter('overlay', (g, v) => {
    overlay.paint(g, v);
    if (overlay.moving) stage.invalidate('overlay');
  });
  effect(() => {
    for (const each of overlays) each.watch();
    stage.invalidate('overlay');
  });
  const c: Context = {
    ...o,
    ...named,
    care,
    ownership: new Ownership(editor, file, scenes, care, client, library.opened),
    following: new Following(editor, library, care, client),
    importing,
    generation,
    sharing: new Sharing(editor, file, library, care, client, (at) => {
      stage.view.look(at.camera);
      stage.viewChanged();
      editor.playhead.moveTo(at.time);
    }),
    gestures: new Gestures(stage, editor, placement, picture, overlay, generation, made),
    playback: new Playback(editor, stage),
    clipboard: clipboardOf(() => c),
    reveal: (ids) => reveal(c, ids),
    focusText,
    openMenu: () => openMenu(c),
    openFrom: async (hash) => (await c.sharing.openFrom(hash)) || c.following.openFrom(hash),
    chooseFiles: fileChooser((files) => void importing.files(files)),
    choosePart: fileChooser(([file]) => void (file && importing.part(file))),
    focusField,
    focusGroup,
    focusAgent,
    focusName,
    fit: () => fitScene(c),
    lookAtScene: () => lookAtOpened(c),
  };
  return c;
}

/** Links between parts. */
function connect(c: Context): void {
  const { editor, gestures, generation, library, playback, stage, ui } = c;
  followView(stage);
  lookAtMade(c);
  keepInView(c);
  keepInSight(c);
  stage.framed.listen((now) => {
    gestures.frame(now);
    playback.frame(now);
    c.driving.frame(now);
    followSelected(c);
    followDriven(c);
  });
  // For screen readers and for scripts: the shown state is not final yet.
  effect(() => {
    const loading = editor.answers.status.value.kind === 'loading';
    const busy = editor.asking() || loading || gliding.value || editor.reading.throttle.waiting.value;
    stage.element.setAttribute('aria-busy', String(busy));
  });
  gestures.tapped.listen((fingers) => perform(c, fingers === 2 ? 'undo' : 'redo'));
  gestures.menu.listen((at, on, future) => ui.openContextMenu({ ...at, on, future }));
  addEventListener('hashchange', () => void c.openFrom(location.hash));
  library.askBy((missing) => {
    // Events of the recording; with changes from an earlier session their answer has the events.
    if (!editor.answers.motion.peek().stale) void generation.score();
    if (missing !== 'none') generation.begin(missing === 'everybody');
  });
  stage.viewChanged();
}

/** Adds everything around the present picture. */
export function layOut(o: Opening): Context {
  const c = makeParts(o);
  connect(c);
  drawPage(c);
  listenToPage(c);
  listenToClipboard(c);
  coach(c);
  return c;
}
