// Edit: copies, removal, locks, kinds, names; what single road users do while others change.
import { kindsWords, KIND_NAMES, PLACED_KINDS } from '../model/kinds';
import type { Others } from '../model/scene';
import { doing } from '../model/scene';
import { lockedWords, removeSelected } from '../edit/copying';
import * as several from '../edit/several';
import { hasAgent, hasScene, hasSome, inGroup, onSome, type Action } from './action';
import type { Context } from './context';

type Plain = Omit<Action, 'group'>;

const kinds = PLACED_KINDS.map((kind): Plain => ({
  id: `kind-${kind}`,
  label: `Make it a ${KIND_NAMES[kind].toLowerCase()}`,
  icon: kind,
  help: 'In the usual size; it drives, rides or walks as its kind does',
  checked: (c) => {
    const all = c.editor.chosenOnes;
    return all.length > 0 && all.every((a) => a.kind === kind);
  },
  ...onSome((_, all) => several.setKind(all, kind)),
}));

const does = (id: Others, key: string, label: string, help: string): Plain => ({
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
    if (command) c.editor.run(command);
  },
});

const mirroring = onSome((_, all) => several.mirrorAll(all));

function lock({ editor }: Context): void {
  const all = editor.chosenOnes;
  const on = !all.every((a) => a.locked);
  const command = several.lockAll(all, on);
  if (!command) return;
  editor.run(command);
  editor.notices.show({ text: `${command.name}.`, undo: true });
  editor.notices.say(`${command.name}.`);
}

export const edit = inGroup('Edit', [
  {
    id: 'copy',
    label: 'Copy',
    keys: ['Ctrl+C'],
    icon: 'copy',
    help: 'The selected road users, also for another tab',
    native: true,
    when: hasSome,
    run: (c) => c.clipboard.copy(),
  },
  {
    id: 'cut',
    label: 'Cut',
    keys: ['Ctrl+X'],
    icon: 'cut',
    help: 'Copies them, and takes them out of the scene',
    native: true,
    when: hasSome,
    run: (c) => c.clipboard.cut(),
  },
  {
    id: 'paste',
    label: 'Paste here',
    keys: ['Ctrl+V'],
    icon: 'paste',
    help: 'What was copied, under the pointer',
    native: true,
    when: hasScene,
    run: (c) => c.clipboard.paste(),
  },
  {
    id: 'duplicate',
    label: 'Duplicate',
    keys: ['Ctrl+D', 'Ctrl+J'],
    icon: 'plus',
    help: 'The same again, at the nearest free place',
    when: hasSome,
    run: (c) => c.copying.duplicate(),
  },
  {
    id: 'mirror',
    label: 'Mirror',
    keys: ['Alt+M'],
    icon: 'swap',
    help: 'Left and right change sides, as the first of them sees it; goals come along',
    ...mirroring,
    when: (c) => {
      const [one, ...more] = c.editor.chosenOnes;
      return one && !more.length && !one.goal.pos && !one.goal.via.length
        ? 'One alone is mirrored by its goal. Set one first.'
        : mirroring.when!(c);
    },
  },
  {
    id: 'delete',
    label: 'Delete',
    keys: ['Del', 'Backspace'],
    icon: 'trash',
    help: 'Takes the selected road users out of the scene',
    when: (c) => {
      const all = c.editor.chosenOnes;
      return !all.length ? 'Select road users first.' : all.every((a) => a.locked) ? lockedWords(all.length) : true;
    },
    run: (c) => removeSelected(c.editor),
  },
  {
    id: 'lock',
    label: 'Lock',
    keys: ['Ctrl+L'],
    icon: 'lock',
    help: 'Locked road users cannot be moved, changed or removed',
    when: hasSome,
    checked: (c) => {
      const all = c.editor.chosenOnes;
      return all.length > 0 && all.every((a) => a.locked);
    },
    run: lock,
  },
  {
    id: 'name',
    label: 'Name',
    keys: ['F2'],
    icon: 'pencil',
    help: 'Give the selected road user a name',
    when: hasAgent,
    run: (c) => c.focusText('name'),
  },
  {
    id: 'note',
    label: 'Note',
    icon: 'note',
    help: 'Write down what matters about the selected road user',
    when: hasAgent,
    run: (c) => c.focusText('note'),
  },
  ...kinds,
  does('react', 'Shift+1', 'React', 'The selected ones adapt to what others do'),
  does('log', 'Shift+2', 'Replay log', 'The selected ones do what was recorded'),
  does('still', 'Shift+3', 'Hold still', 'The selected ones stay where they start'),
  {
    id: 'menu',
    label: 'Menu of what is selected',
    keys: ['Menu', 'Shift+F10'],
    icon: 'menu',
    help: 'The same as the right button, or a finger that rests',
    when: hasScene,
    run: (c) => c.openMenu(),
  },
]);

/** `8 pedestrians, 2 cyclists` */
export const selectedWords = (c: Context): string => kindsWords(c.editor.chosenOnes.map((a) => a.kind));
