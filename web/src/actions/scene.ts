// Scene: the list, new ones and copies, files in and out, what was done.
import type { Others } from '../model/scene';
import { resetAll, setOthers } from '../model/commands';
import { hasScene, inGroup, type Action } from './action';
import type { Context } from './context';

const others = (mode: Others, label: string, help: string): Omit<Action, 'group'> => ({
  id: `others-${mode}`,
  label,
  help,
  when: hasScene,
  checked: (c) => c.editor.resting.value?.others === mode,
  run: (c) => c.editor.run(setOthers(mode)),
});

/** The scene that is spoken of: one in the list that is pointed at, else the open one. */
const meant = ({ editor, ui }: Context): string | null => ui.aimed.value ?? editor.resting.value?.id ?? null;

/** Own scenes alone can be changed on the server. */
const own = (c: Context): true | string => {
  const id = meant(c);
  return !id ? 'No scene is open.' : c.scenes.isOwn(id) ? true : 'Examples stay as they are. Copy one to change it.';
};

const making = (c: Context): boolean => c.editor.layouts.isOpen.value;

const isMaking = (c: Context): true | string => (making(c) ? true : 'No map is being made.');

export const scene = inGroup('Scene', [
  {
    id: 'scenes',
    label: 'Scenes',
    keys: ['B'],
    icon: 'list',
    help: 'List of scenes',
    checked: (c) => c.ui.drawer.value === 'scenes',
    run: (c) => c.ui.toggleDrawer('scenes'),
  },
  {
    id: 'users',
    label: 'Road users',
    keys: ['W'],
    icon: 'people',
    help: 'Who is in the scene, by kind, with a goal, in an event',
    when: hasScene,
    checked: (c) => c.ui.drawer.value === 'users',
    run: (c) => c.ui.toggleDrawer('users'),
  },
  {
    id: 'history',
    label: 'History',
    keys: ['Ctrl+H'],
    icon: 'clock',
    help: 'What was done, step by step; a click goes there',
    when: hasScene,
    checked: (c) => c.ui.drawer.value === 'history',
    run: (c) => c.ui.toggleDrawer('history'),
  },
  {
    id: 'new-map',
    label: 'New map',
    keys: ['Ctrl+N'],
    icon: 'plus',
    help: 'Crossings, roundabouts, merges, roads and car parks from templates',
    run: (c) => c.maker.begin(),
  },
  {
    id: 'change-map',
    label: 'Change the map',
    icon: 'pencil',
    help: 'Other parameters for a map from a template; the scene gets a copy with it',
    when: (c) =>
      !c.editor.isOpen.value ? 'No scene is open.' : c.maker.madeFrom ? true : 'This map is from no template.',
    run: (c) => c.maker.change(),
  },
  {
    id: 'use-map',
    label: 'Use this map',
    keys: ['Enter'],
    help: 'A scene with the map that is being made',
    onOffer: making,
    when: isMaking,
    run: (c) => void c.maker.use(),
  },
  {
    id: 'arm-previous',
    label: 'Previous arm',
    keys: ['['],
    icon: 'prev',
    help: 'The arm before, of a map that is being made',
    onOffer: making,
    when: isMaking,
    run: (c) => c.editor.layouts.step(-1),
  },
  {
    id: 'arm-next',
    label: 'Next arm',
    keys: [']'],
    icon: 'next',
    help: 'The arm after it, of a map that is being made',
    onOffer: making,
    when: isMaking,
    run: (c) => c.editor.layouts.step(1),
  },
  {
    id: 'arm-remove',
    label: 'Remove the arm',
    keys: ['Del'],
    help: 'Three stay at least',
    onOffer: making,
    when: isMaking,
    run: (c) => c.editor.layouts.removeArm(c.editor.layouts.arm.peek()),
  },
  {
    id: 'new-scene',
    label: 'New scene on this road',
    keys: ['Shift+N'],
    icon: 'plus',
    help: 'The road of this scene with nobody on it',
    when: hasScene,
    run: (c) => void c.care.newOnThisRoad(),
  },
  {
    id: 'new-plain-scene',
    label: 'New scene on plain ground',
    icon: 'plus',
    help: 'Nothing there: no road, nobody',
    run: (c) => void c.care.newOnPlainGround(),
  },
  {
    id: 'choose-files',
    label: 'Import files',
    keys: ['Ctrl+O'],
    icon: 'file',
    help: 'Scenes, recordings, tables of motion and maps',
    context: 'always',
    run: (c) => c.ui.openDialog('import'),
  },
  {
    id: 'import-log',
    label: 'Import a log',
    keys: ['O'],
    icon: 'file',
    help: 'Scenario record or saved scene. Or drop the file here.',
    onOffer: (c) => c.editor.resting.value?.agents.size === 0,
    run: (c) => c.chooseFiles(),
  },
  {
    id: 'save-copy',
    label: 'Save a copy',
    keys: ['Ctrl+S'],
    icon: 'copy',
    help: 'An own scene that saves itself',
    context: 'always',
    when: hasScene,
    run: (c) => void c.care.saveCopy(),
  },
  {
    id: 'save-as',
    label: 'Save as …',
    keys: ['Ctrl+Shift+S'],
    icon: 'copy',
    help: 'A copy under a name of your own',
    context: 'always',
    when: hasScene,
    run: (c) => c.ui.openDialog('save-as'),
  },
  {
    id: 'duplicate-scene',
    label: 'Duplicate scene',
    icon: 'copy',
    help: 'A copy beside it',
    when: (c) => (meant(c) ? true : 'No scene is open.'),
    run: (c) => void c.care.duplicate(meant(c)!),
  },
  {
    id: 'rename-scene',
    label: 'Rename scene',
    keys: ['Shift+F2'],
    icon: 'pencil',
    help: 'Another name for it',
    when: own,
    run(c) {
      const id = meant(c)!;
      if (c.ui.drawer.peek() === 'scenes') c.ui.renameScene(id);
      else c.focusName();
    },
  },
  {
    id: 'delete-scene',
    label: 'Delete scene',
    icon: 'trash',
    help: 'Can be undone for a while; examples stay',
    when: own,
    run: (c) => void c.care.remove(meant(c)!),
  },
  {
    id: 'share',
    label: 'Share',
    keys: ['Ctrl+Shift+C'],
    icon: 'share',
    help: 'A link with the whole scene inside',
    when: hasScene,
    run: (c) => c.ui.openDialog('share'),
  },
  {
    id: 'export',
    label: 'Export',
    keys: ['Ctrl+E'],
    icon: 'export',
    help: 'Files for other programs, pictures, a film, a report',
    when: hasScene,
    run: (c) => {
      c.variants.setScope('present');
      c.ui.openDialog('export');
    },
  },
  others('react', 'Others react', 'Everybody you gave no goal adapts when you let go'),
  others('log', 'Others replay the log', 'They do what was recorded'),
  others('still', 'Others hold still', 'They stay where they start, and nobody else comes in'),
  {
    id: 'reset-all',
    label: 'Everybody back to the log',
    icon: 'undo',
    help: 'Drops every change; can be undone',
    when: hasScene,
    run: (c) => c.editor.run(resetAll(c.editor.scene.value!)),
  },
]);
