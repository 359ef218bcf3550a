// Scene: the list, files in and out, what the others do.
import type { Others } from '../model/scene';
import { resetAll, setOthers } from '../model/commands';
import { download } from '../edit/download';
import { hasScene, inGroup, type Action } from './action';

const others = (mode: Others, label: string, help: string): Omit<Action, 'group'> => ({
  id: `others-${mode}`,
  label,
  help,
  when: hasScene,
  checked: (c) => c.editor.scene.value?.others === mode,
  run: (c) => c.editor.run(setOthers(mode)),
});

export const scene = inGroup('Scene', [
  {
    id: 'scenes',
    label: 'Scenes',
    keys: ['B'],
    icon: 'list',
    help: 'List of scenes',
    checked: (c) => c.ui.drawer.value,
    run: (c) => c.ui.showDrawer(!c.ui.drawer.value),
  },
  {
    id: 'choose-files',
    label: 'Choose files',
    keys: ['Ctrl+O'],
    icon: 'file',
    help: 'Scenario records, lane maps and saved scenes',
    context: 'always',
    run: (c) => c.chooseFiles(),
  },
  {
    id: 'import-log',
    label: 'Import a log',
    keys: ['O'],
    icon: 'file',
    help: 'Scenario record or saved scene. Or drop the file here.',
    onOffer: (c) => c.editor.scene.value?.agents.size === 0,
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
    run: (c) => void c.library.saveCopy(),
  },
  {
    id: 'export-json',
    label: 'Export scene (JSON)',
    icon: 'export',
    help: 'Everything, to be opened again here',
    when: hasScene,
    run: (c) => void download(c, 'dragtraffic'),
  },
  {
    id: 'export-womd',
    label: 'Export scenario record (Waymo TFRecord)',
    icon: 'export',
    help: 'The motion on screen as a Scenario record',
    when: hasScene,
    run: (c) => void download(c, 'womd'),
  },
  others('react', 'Others react', 'Everybody you gave no goal adapts when you let go'),
  others('log', 'Others replay the log', 'They do what was recorded'),
  others('still', 'Others hold still', 'They stay where they start, and nobody else comes in'),
  {
    id: 'delete-scene',
    label: 'Delete this scene',
    icon: 'trash',
    help: 'Asks first; examples stay',
    when: (c) =>
      !c.editor.scene.value
        ? 'No scene is open.'
        : c.scenes.isOwn(c.editor.scene.value.id)
          ? true
          : 'Examples cannot be deleted.',
    run: (c) => c.ui.askToDelete(c.editor.scene.value!.id),
  },
  {
    id: 'reset-all',
    label: 'Everybody back to the log',
    icon: 'undo',
    help: 'Drops every change; can be undone',
    when: hasScene,
    run: (c) => c.editor.run(resetAll(c.editor.scene.value!)),
  },
]);
