// Edit: copies, removal, locks, kinds, names; behaviour of single road users when others change.
import type { Help } from '../texts/desk/helps';
import { kindsWords, KIND_WORDS, PLACED_KINDS } from '../model/base/kinds';
import type { Others } from '../model/document/scene';
import { doing } from '../model/document/scene';
import { lockedWords, removeSelected } from '../edit/moves/copying';
import * as several from '../edit/moves/several';
import { hasAgent, hasScene, hasSome, inGroup, onSome, type Action } from './action';
import type { Context } from './context';
import { TEXTS } from '../texts/desk/actions';

type UngroupedAction = Omit<Action, 'group'>;

const kinds = PLACED_KINDS.map((kind): UngroupedAction => ({
  id: `kind-${kind}`,
  label: TEXTS.changeTo(KIND_WORDS[kind]),
  icon: kind,
  help: 'inTheUsual' as const,
  checked: (c) => {
    const all = c.editor.chosenOnes;
    return all.length > 0 && all.every((a) => a.kind === kind);
  },
  ...onSome((_, all) => several.setKind(all, kind)),
}));

const does = (id: Others, key: string, label: string, help: Help): UngroupedAction => ({
  id: `does-${id}`,
  label,
  keys: [key],
  help,
  when: hasSome,
  checked: (c) => {
    const scene = c.editor.scene.value;
    const all = c.editor.chosenOnes;
    return scene !== null && all.length > 0 && all.every((a) => doing(scene, a) === id);
  },
  run(c) {
    const command = several.setDoes(c.editor.scene.peek()!, c.editor.chosenOnes, id);
    if (!command) return;
    c.editor.commits.run(command);
    c.editor.notices.show({ text: `${command.name}.`, undo: true });
  },
});

const mirroring = onSome((_, all) => several.mirrorAll(all));

const swapping = onSome((_, all) => several.swapTwo(all));

function lock({ editor }: Context): void {
  const all = editor.chosenOnes;
  const on = !all.every((a) => a.locked);
  const command = several.lockAll(all, on);
  if (!command) return;
  editor.commits.run(command);
  editor.notices.show({ text: `${command.name}.`, undo: true });
  editor.notices.say(`${command.name}.`);
}

export const edit = inGroup('edit', [
  {
    id: 'copy',
    label: TEXTS.copy,
    keys: ['Ctrl+C'],
    icon: 'copy',
    help: 'theSelected',
    native: true,
    when: hasSome,
    run: (c) => c.clipboard.copy(),
  },
  {
    id: 'cut',
    label: TEXTS.cut,
    keys: ['Ctrl+X'],
    icon: 'cut',
    help: 'copiesThem',
    native: true,
    when: hasSome,
    run: (c) => c.clipboard.cut(),
  },
  {
    id: 'paste',
    label: TEXTS.pasteHere,
    keys: ['Ctrl+V'],
    icon: 'paste',
    help: 'theCopiedRoadUsers',
    native: true,
    when: hasScene,
    run: (c) => c.clipboard.paste(),
  },
  {
    id: 'duplicate',
    label: TEXTS.duplicate,
    keys: ['Ctrl+D', 'Ctrl+J'],
    icon: 'plus',
    help: 'aCopyNearby',
    when: hasSome,
    run: (c) => c.copying.duplicate(),
  },
  {
    id: 'mirror',
    label: TEXTS.mirror,
    keys: ['Alt+M'],
    icon: 'swap',
    help: 'leftAndRight',
    ...mirroring,
    when: (c) => {
      const [one, ...more] = c.editor.chosenOnes;
      return one && !more.length && !one.goal.pos && !one.goal.via.length
        ? TEXTS.mirroringNeedsAGoal
        : mirroring.when!(c);
    },
  },
  {
    id: 'swap',
    label: TEXTS.swapPositions,
    keys: ['Alt+X'],
    icon: 'swap',
    help: 'swapsStartPositions',
    ...swapping,
    when: (c) => (c.editor.chosenOnes.length === 2 ? swapping.when!(c) : TEXTS.selectTwo),
  },
  {
    id: 'delete',
    label: TEXTS.delete,
    keys: ['Del', 'Backspace'],
    icon: 'trash',
    help: 'removesTheSelected',
    when: (c) => {
      const all = c.editor.chosenOnes;
      return !all.length ? TEXTS.selectRoadUsers : all.every((a) => a.locked) ? lockedWords(all.length) : true;
    },
    run: (c) => removeSelected(c.editor),
  },
  {
    id: 'lock',
    label: TEXTS.lock,
    keys: ['Ctrl+L'],
    icon: 'lock',
    help: 'lockedRoad',
    when: hasSome,
    checked: (c) => {
      const all = c.editor.chosenOnes;
      return all.length > 0 && all.every((a) => a.locked);
    },
    run: lock,
  },
  {
    id: 'name',
    label: TEXTS.name,
    keys: ['F2'],
    icon: 'pencil',
    help: 'namesTheSelected',
    when: hasAgent,
    run: (c) => c.focusText('name'),
  },
  {
    id: 'note',
    label: TEXTS.note,
    icon: 'note',
    help: 'addsANote',
    when: hasAgent,
    run: (c) => {
      c.ui.showAllFields(true);
      c.focusText('note');
    },
  },
  ...kinds,
  does('react', 'Shift+1', TEXTS.react, 'theSelectedReact'),
  does('log', 'Shift+2', TEXTS.replayLog, 'theSelectedReplay'),
  does('still', 'Shift+3', TEXTS.holdStill, 'theSelectedHoldStill'),
  {
    id: 'menu',
    label: TEXTS.contextMenu,
    keys: ['Menu', 'Shift+F10'],
    icon: 'menu',
    help: 'theSameAsThe',
    when: hasScene,
    run: (c) => c.openMenu(),
  },
]);

/** `8 pedestrians, 2 cyclists` */
export const selectedWords = (c: Context): string => kindsWords(c.editor.chosenOnes.map((a) => a.kind));
