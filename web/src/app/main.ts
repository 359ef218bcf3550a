// Start-up: builds the page, wires keys, files and frames, opens the first scene.
import '../styles/tokens.css';
import '../styles/base.css';
import '../styles/panels.css';
import { effect } from '@preact/signals-core';
import type { Context } from '../actions/context';
import { Ui } from '../actions/ui';
import { actionForKey, perform } from '../actions/registry';
import { keyOf } from '../actions/keys';
import { Editor } from '../edit/editor';
import { Library } from '../edit/library';
import { Generation } from '../edit/generation';
import { Importing } from '../edit/importing';
import { Saving } from '../edit/saving';
import { SceneFile } from '../edit/scene-file';
import { SceneList } from '../edit/scene-list';
import { HttpGenerator } from '../net/http-generator';
import { Picture } from '../edit/picture';
import { Gestures } from '../edit/gestures/pointer';
import { Playback } from '../edit/playback';
import { Stage } from '../draw/stage';
import { Client } from '../net/client';
import { recall } from '../net/storage';
import { hasGoal } from '../model/scene';
import { poseAt } from '../model/motion';
import { h, swap } from './dom';
import { topBar } from './topbar';
import { hud, watchView } from './hud';
import { drawer } from './drawer';
import { agentPanel } from './inspector';
import { eventsPanel, scenePanel } from './scenepanel';
import { timeline } from './timeline';
import { dialogs } from './dialogs';
import { handleSliders, liveRegion, roadUserList } from './access';
import { emptyState } from './empty';
import { busyBox, sceneCentre } from './thumbs';

const FIRST_SCENE = 'demo-crossing';
const WIDE = 1300;
/** How much of the map the height of the picture shows at first. */
const OPENING_M = 88;

function build(): Context {
  const ui = new Ui();
  effect(() => {
    document.documentElement.dataset.theme = ui.theme.value;
  });
  const client = new Client();
  const editor = new Editor();
  const scenes = new SceneList(client);
  const file = new SceneFile(editor);
  const saving = new Saving(editor, file, scenes, client);
  const library = new Library(editor, file, saving, scenes, client);
  const importing = new Importing(editor, library, scenes, client);
  const generation = new Generation(editor, file, saving, new HttpGenerator(client));
  const main = h('main', { class: 'stage', 'aria-label': 'Traffic scene' });
  const root = document.getElementById('app')!;
  root.append(main);
  const stage = new Stage(main);
  const picture = new Picture(stage, editor);
  const gestures = new Gestures(stage, editor, picture, generation);
  const playback = new Playback(editor, stage);
  const files = h('input', {
    type: 'file',
    multiple: true,
    class: 'sr',
    tabindex: '-1',
    'aria-hidden': 'true',
    onchange: () => {
      void importing.files([...(files.files ?? [])]);
      files.value = '';
    },
  });
  const c: Context = {
    editor,
    generation,
    scenes,
    library,
    file,
    saving,
    importing,
    playback,
    gestures,
    picture,
    stage,
    client,
    ui,
    chooseFiles: () => files.click(),
    focusField,
    focusGroup,
    focusAgent: (id) => document.querySelector<HTMLElement>(`[data-agent="${CSS.escape(id)}"]`)?.focus(),
    fit: () => fit(c),
  };
  ui.showDrawer(innerWidth >= WIDE);
  watchView(c);
  const insp = h(
    'aside',
    { class: 'insp', 'aria-label': 'Inspector', 'data-group': 'inspector' },
    swap(
      () =>
        ui.eventsPanel.value && editor.events.value.length
          ? 'events'
          : editor.selection.value
            ? `agent:${editor.selection.value}`
            : `scene:${editor.scene.value?.id}`,
      () =>
        ui.eventsPanel.peek() && editor.events.peek().length
          ? eventsPanel(c)
          : editor.selection.peek()
            ? agentPanel(c, editor.selection.peek()!)
            : scenePanel(c),
    ),
  );
  main.append(
    emptyState(c),
    roadUserList(c),
    handleSliders(c),
    hud(c, picture),
    swap(
      () => ui.drawer.value && editor.scene.value !== null,
      () => (ui.drawer.peek() && editor.scene.peek() ? drawer(c) : null),
    ) as HTMLElement,
  );
  root.prepend(topBar(c));
  root.append(insp, timeline(c), h('div', { class: 'swap' }, dialogs(c), liveRegion(c), files));
  stage.onFrame = (now) => {
    gestures.frame(now);
    playback.frame(now);
    if (editor.playhead.follow.peek() && editor.playing.peek()) follow(c);
  };
  effect(() => {
    main.classList.toggle('bare', editor.scene.value === null);
  });
  effect(() => {
    void ui.theme.value;
    stage.themeChanged();
  });
  effect(() => {
    stage.view.inset = { left: ui.drawer.value ? 324 : 68, right: 12, top: 12, bottom: 56 };
  });
  library.onOpen = () => {
    fit(c, true);
    ui.showEvents(false);
    // Events of the log; with changes from last time the answer to them brings its own.
    if (!editor.motion.peek().stale) void generation.score();
  };
  void document.fonts?.ready.then(() => stage.invalidate('agents', 'overlay'));
  return c;
}

/** Everything, or on opening the part where people are, at a zoom that shows what they do. */
function fit(c: Context, opening = false): void {
  const scene = c.editor.scene.peek();
  if (!scene) return;
  c.stage.resize();
  const v = c.stage.view;
  if (opening) {
    // The same stretch of road on every screen: a junction with the beginnings of its arms.
    const z = Math.max(4.4, Math.min(8.5, (v.h - v.inset.top - v.inset.bottom) / OPENING_M));
    v.fit(busyBox(scene), 1.1 * z, z);
    v.centre(...sceneCentre(scene));
  } else v.fit(scene.map.box);
  c.stage.invalidate('map');
  c.stage.viewChanged();
}

function follow(c: Context): void {
  const a = c.editor.agent.peek();
  const p = a && poseAt(c.editor.motionFor(a), c.editor.time.peek());
  if (!p) return;
  c.stage.view.centre(p.x, p.y);
  c.stage.viewChanged();
}

function focusField(part: 'start' | 'goal', field: string): void {
  const el = document.querySelector<HTMLInputElement>(`[data-field="${part}-${field}"]`);
  el?.focus();
  el?.select();
}

function focusGroup(step: 1 | -1): void {
  const groups = [...document.querySelectorAll<HTMLElement>('[data-group]')];
  const order = ['top', 'scenes', 'users', 'handles', 'inspector', 'timeline'];
  groups.sort((a, b) => order.indexOf(a.dataset.group!) - order.indexOf(b.dataset.group!));
  const at = groups.findIndex((g) => g.contains(document.activeElement));
  const next = groups[(at + step + groups.length) % groups.length];
  next
    ?.querySelector<HTMLElement>(
      '[aria-pressed="true"][data-agent], button:not([tabindex="-1"]), input, [tabindex="0"]',
    )
    ?.focus();
}

function keys(c: Context): void {
  addEventListener('keydown', (e) => {
    const target = e.target as HTMLElement;
    const typing = target instanceof HTMLInputElement && target.type !== 'range';
    const a = actionForKey(keyOf(e));
    if (!a || e.defaultPrevented) return;
    // In a number field undo is the browser's only while something is typed that has not been taken over.
    const undoing =
      (a.id === 'undo' || a.id === 'redo') && typing && !!target.dataset.field && !('typed' in target.dataset);
    if (typing && a.context !== 'always' && !undoing) return;
    if (c.ui.dialog.peek() && a.context !== 'always') return;
    // Tab walks through road users only from the picture; elsewhere it is the browser's.
    if (/^(Shift\+)?Tab$/.test(a.keys![0]) && !(target === document.body || target.closest('[data-group="users"]')))
      return;
    // A button's own keys; in the list of road users they select first, and after that Enter goes on to the inspector.
    if (
      target instanceof HTMLButtonElement &&
      (e.key === ' ' || e.key === 'Enter') &&
      !e.ctrlKey &&
      (!target.dataset.agent || target.dataset.agent !== c.editor.selection.peek())
    )
      return;
    if (target instanceof HTMLInputElement && target.type === 'range' && e.key.startsWith('Arrow')) return;
    if (c.editor.drag.peek() && a.id !== 'deselect') return;
    e.preventDefault();
    perform(c, a.id);
  });
}

/**
 * A click with the mouse leaves no focus on a button: the Space that follows is meant to play. Keys keep theirs, and
 * so do dialogs and menus, which hand the focus back themselves.
 */
function clicks(): void {
  addEventListener('click', (e) => {
    const button = e.detail > 0 && e.target instanceof Element ? e.target.closest('button') : null;
    if (button && button === document.activeElement && !button.closest('.dlg, .menu')) button.blur();
  });
}

function drops(c: Context): void {
  let depth = 0;
  const veil = h('div', { class: 'dropping' }, 'Drop to import');
  const over = (on: boolean) => {
    if (on) c.stage.element.append(veil);
    else {
      veil.remove();
      depth = 0;
    }
  };
  addEventListener('dragenter', (e) => {
    if (e.dataTransfer?.types.includes('Files')) {
      depth++;
      over(true);
    }
  });
  addEventListener('dragleave', () => {
    if (--depth <= 0) over(false);
  });
  addEventListener('dragover', (e) => e.preventDefault());
  addEventListener('drop', (e) => {
    e.preventDefault();
    over(false);
    const list = [...(e.dataTransfer?.files ?? [])];
    if (list.length) void c.importing.files(list);
  });
}

/** The three-step hint moves on with what one does and closes for good after the first drop. */
function coaching(c: Context): void {
  const { editor, ui } = c;
  let opened = ui.drawer.peek();
  effect(() => {
    const a = editor.agent.value;
    if (a && opened) {
      opened = false;
      ui.showDrawer(false);
    }
    if (!ui.coach.peek()) return;
    if (ui.coach.peek() === 1 && a) ui.coachTo(2);
    if (editor.drag.value && ui.coach.peek() === 2) ui.coachTo(3);
    if (a && hasGoal(a.goal) && !editor.drag.value && ui.coach.peek() === 3) ui.endCoach();
  });
}

/** An error nobody caught is said once; what was changed is saved already. */
function crashes(c: Context): void {
  const say = (e: unknown): void => {
    c.editor.notices.crashed(e);
  };
  addEventListener('error', (e) => {
    if (e.error) say(e.error);
  });
  addEventListener('unhandledrejection', (e) => {
    if ((e.reason as Error | null)?.name !== 'AbortError') say(e.reason);
  });
}

async function start(): Promise<void> {
  const c = build();
  crashes(c);
  keys(c);
  clicks();
  drops(c);
  coaching(c);
  const wanted = new URLSearchParams(location.search).get('scene') ?? recall<string>('last-scene');
  try {
    await c.scenes.refresh();
    const ids = c.scenes.list.peek().map((s) => s.id);
    const id = [wanted, FIRST_SCENE, ids[0]].find((i) => i && ids.includes(i));
    if (id) {
      await c.library.open(id);
      if (c.ui.coach.peek() && c.editor.scene.peek()) c.playback.introduce(3);
    } else c.editor.answers.report({ kind: 'ready' });
  } catch {
    waitForServer(c);
  }
}

/** Nothing to show without the server; ask again at the usual intervals. */
function waitForServer(c: Context): void {
  let tries = 0;
  const again = (): void => {
    const wait = [1, 2, 4, 6][Math.min(3, tries++)];
    let left = wait;
    c.editor.answers.report({ kind: 'away' });
    c.editor.answers.missing({ retryIn: left, waiting: 0 });
    const timer = setInterval(() => {
      left--;
      c.editor.answers.missing({ retryIn: Math.max(0, left), waiting: 0 });
      if (left > 0) return;
      clearInterval(timer);
      void c.client.answers().then((ok) => {
        if (ok) location.reload();
        else again();
      });
    }, 1000);
  };
  again();
}

void start();
