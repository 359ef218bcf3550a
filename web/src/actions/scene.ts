// Scene: the list, new ones and copies, files in and out, history.
import type { Help } from '../texts/desk/helps';
import type { Others } from '../model/document/scene';
import { resetAll, setOthers } from '../model/document/commands';
import { hasScene, inGroup, type Action } from './action';
import type { Context } from './context';
import { TEXTS } from '../texts/desk/actions';

const others = (mode: Others, label: string, help: Help): Omit<Action, 'group'> => ({
  id: `others-${mode}`,
  label,
  help,
  when: hasScene,
  checked: (c) => c.editor.resting.value?.others === mode,
  run: (c) => c.editor.commits.run(setOthers(mode)),
});

/** The scene of the action: the one aimed at in the list, else the open one. */
const meant = ({ editor, ui }: Context): string | null => ui.aimed.value ?? editor.resting.value?.id ?? null;

/** Only own scenes can be changed on the server. */
const own = (c: Context): true | string => {
  const id = meant(c);
  return !id ? TEXTS.noSceneIsOpen : c.scenes.isOwn(id) ? true : TEXTS.examplesAreReadOnly;
};

const making = (c: Context): boolean => c.layouts.isOpen.value;

const isMaking = (c: Context): true | string => (making(c) ? true : TEXTS.noMapIsBeing);

export const scene = inGroup('scene', [
  {
    id: 'scenes',
    label: TEXTS.scenes,
    keys: ['B'],
    icon: 'list',
    help: 'listOfScenes',
    checked: (c) => c.ui.drawer.value === 'scenes',
    run: (c) => c.ui.toggleDrawer('scenes'),
  },
  {
    id: 'users',
    label: TEXTS.roadUsers,
    keys: ['W'],
    icon: 'people',
    help: 'listsTheRoadUsers',
    when: hasScene,
    checked: (c) => c.ui.drawer.value === 'users',
    run: (c) => c.ui.toggleDrawer('users'),
  },
  {
    id: 'history',
    label: TEXTS.history,
    keys: ['Ctrl+H'],
    icon: 'clock',
    help: 'listsAllSteps',
    when: hasScene,
    checked: (c) => c.ui.drawer.value === 'history',
    run: (c) => c.ui.toggleDrawer('history'),
  },
  {
    id: 'new-map',
    label: TEXTS.newMap,
    // Browsers reserve Ctrl+N for a new window.
    keys: ['Shift+T', 'Ctrl+N'],
    icon: 'plus',
    help: 'crossingsRoundabouts',
    run: (c) => c.maker.begin(),
  },
  {
    id: 'change-map',
    label: TEXTS.changeTheMap,
    icon: 'pencil',
    help: 'otherParameters',
    when: (c) => (!c.editor.isOpen.value ? TEXTS.noSceneIsOpen : c.maker.madeFrom ? true : TEXTS.thisMapIsFrom),
    run: (c) => c.maker.change(),
  },
  {
    id: 'use-map',
    label: TEXTS.useThisMap,
    keys: ['Enter'],
    help: 'aSceneWith',
    onOffer: making,
    when: isMaking,
    run: (c) => void c.maker.use(),
  },
  {
    id: 'arm-previous',
    label: TEXTS.previousArm,
    keys: ['['],
    icon: 'prev',
    help: 'selectsThePreviousArm',
    onOffer: making,
    when: isMaking,
    run: (c) => c.layouts.step(-1),
  },
  {
    id: 'arm-next',
    label: TEXTS.nextArm,
    keys: [']'],
    icon: 'next',
    help: 'selectsTheNextArm',
    onOffer: making,
    when: isMaking,
    run: (c) => c.layouts.step(1),
  },
  {
    id: 'arm-remove',
    label: TEXTS.removeTheArm,
    keys: ['Del'],
    help: 'keepsThreeArms',
    onOffer: (c) => making(c) && !c.layouts.way.value,
    when: isMaking,
    run: (c) => c.layouts.removeArm(c.layouts.arm.peek()),
  },
  {
    id: 'way-remove',
    label: TEXTS.removeTheConnection,
    keys: ['Del'],
    help: 'removesTheConnection',
    onOffer: (c) => c.layouts.way.value !== null,
    when: (c) => (c.layouts.way.value ? true : TEXTS.noConnectionIs),
    run: (c) => c.layouts.removeWay(c.layouts.way.peek()!),
  },
  {
    id: 'new-scene',
    label: TEXTS.newSceneOnThis,
    keys: ['Shift+N'],
    icon: 'plus',
    help: 'theRoadOfThis',
    when: hasScene,
    run: (c) => void c.care.newOnThisRoad(),
  },
  {
    id: 'new-plain-scene',
    label: TEXTS.newSceneOnPlain,
    icon: 'plus',
    help: 'noMapNoRoadUsers',
    run: (c) => void c.care.newOnPlainGround(),
  },
  {
    id: 'choose-files',
    label: TEXTS.importFiles,
    keys: ['Ctrl+O'],
    icon: 'file',
    help: 'scenesRecordings',
    context: 'always',
    run: (c) => c.ui.openDialog('import'),
  },
  {
    id: 'choose-part',
    label: TEXTS.importPartOfMap,
    icon: 'file',
    help: 'circleOfAMap',
    run: (c) => c.choosePart(),
  },
  {
    id: 'import-log',
    label: TEXTS.importALog,
    keys: ['O'],
    icon: 'file',
    help: 'scenarioRecord',
    onOffer: (c) => c.editor.resting.value?.agents.size === 0,
    run: (c) => c.chooseFiles(),
  },
  {
    id: 'save-copy',
    label: TEXTS.saveACopy,
    keys: ['Ctrl+S'],
    icon: 'copy',
    help: 'yourOwnCopy',
    context: 'always',
    when: hasScene,
    run: (c) => void c.care.saveCopy(),
  },
  {
    id: 'save-as',
    label: TEXTS.saveAs,
    keys: ['Ctrl+Shift+S'],
    icon: 'copy',
    help: 'aCopyUnder',
    context: 'always',
    when: hasScene,
    run: (c) => c.ui.openDialog('save-as'),
  },
  {
    id: 'duplicate-scene',
    label: TEXTS.duplicateScene,
    icon: 'copy',
    help: 'aCopyOfTheScene',
    when: (c) => (meant(c) ? true : TEXTS.noSceneIsOpen),
    run: (c) => void c.care.duplicate(meant(c)!),
  },
  {
    id: 'rename-scene',
    label: TEXTS.renameScene,
    keys: ['Shift+F2'],
    icon: 'pencil',
    help: 'changesItsName',
    when: own,
    run(c) {
      const id = meant(c)!;
      if (c.ui.drawer.peek() === 'scenes') c.ui.renameScene(id);
      else c.focusName();
    },
  },
  {
    id: 'delete-scene',
    label: TEXTS.deleteScene,
    icon: 'trash',
    help: 'canBeUndone',
    when: own,
    run: (c) => void c.care.remove(meant(c)!),
  },
  {
    id: 'share',
    label: TEXTS.share,
    keys: ['Ctrl+Shift+C'],
    icon: 'share',
    help: 'aLinkWithThe',
    when: hasScene,
    run: (c) => c.ui.openDialog('share'),
  },
  {
    id: 'export',
    label: TEXTS.export,
    keys: ['Ctrl+E'],
    icon: 'export',
    help: 'filesForOther',
    when: hasScene,
    run: (c) => {
      c.variants.setScope('present');
      c.ui.openDialog('export');
    },
  },
  others('react', TEXTS.othersReact, 'allReactOnRelease'),
  others('log', TEXTS.othersReplay, 'othersReplayTheLog'),
  others('still', TEXTS.othersHoldStill, 'othersHoldStill'),
  {
    id: 'reset-all',
    label: TEXTS.resetAllToLog,
    icon: 'undo',
    help: 'dropsEvery',
    when: hasScene,
    run: (c) => c.editor.commits.run(resetAll(c.editor.scene.value!)),
  },
]);
