// Select and look: tools, who is selected, the view, the layers.
import { canChange } from '../model/scene';
import { TOOLS } from '../edit/gestures/tools';
import type { Layers } from '../edit/editor';
import { hasAgent, hasScene, inGroup, type Action } from './action';
import type { Context } from './context';

/** Metres of road shown around the selected road user and its goal, and the closest that "zoom to" goes. */
const AROUND_M = 18;
const CLOSEST = 22;

const tools = TOOLS.map(({ name, label, key, icon, help }) => ({
  id: `tool-${name}`,
  label,
  keys: [key],
  icon,
  help,
  checked: (c: Context) => c.editor.tool.value === name,
  run: (c: Context) => c.editor.chooseTool(name),
}));

/** Ids of those who can be changed, nearest to the middle of the picture first. */
function nearestFirst(c: Context): string[] {
  const v = c.stage.view;
  const [x, y] = v.from(v.w / 2, v.h / 2);
  return [...(c.editor.scene.value?.agents.values() ?? [])]
    .filter(canChange)
    .map((a) => ({ id: a.id, d: Math.hypot((a.logStart?.x ?? 0) - x, (a.logStart?.y ?? 0) - y) }))
    .sort((p, q) => p.d - q.d)
    .map((p) => p.id);
}

let walk: { ids: string[]; scene: string | undefined } | null = null;

function walkTo(c: Context, step: 1 | -1): void {
  const scene = c.editor.scene.value?.id;
  const selected = c.editor.selection.value;
  // The order is kept while one walks, or the next key would jump back to the middle.
  if (!walk || walk.scene !== scene || !selected) walk = { ids: nearestFirst(c), scene };
  const { ids } = walk;
  const at = ids.indexOf(selected ?? '');
  const id = ids[at < 0 ? (step > 0 ? 0 : ids.length - 1) : (at + step + ids.length) % ids.length];
  if (!id) return;
  c.editor.select(id);
  c.focusAgent(id);
}

function zoom(c: Context, factor: number): void {
  c.stage.glide.by((v) => v.zoomAt(v.w / 2, v.h / 2, factor));
}

function zoomToSelection(c: Context): void {
  const a = c.editor.agent.value!;
  const p = a.logStart!;
  const g = c.editor.goalPose(a) ?? p;
  const box = {
    x0: Math.min(p.x, g.x) - AROUND_M,
    x1: Math.max(p.x, g.x) + AROUND_M,
    y0: Math.min(p.y, g.y) - AROUND_M,
    y1: Math.max(p.y, g.y) + AROUND_M,
  };
  c.stage.glide.by((v) => v.fit(box, CLOSEST));
}

const layer = (name: keyof Layers, label: string, key: string, help: string): Omit<Action, 'group'> => ({
  id: `layer-${name}`,
  label,
  keys: [key],
  help,
  when: hasScene,
  checked: (c) => c.editor.layers.value[name],
  run: (c) => c.editor.toggleLayer(name),
});

export const look = inGroup('Select and look', [
  ...tools,
  {
    id: 'next-agent',
    label: 'Next road user',
    keys: ['Tab'],
    help: 'Nearest to the middle of the picture first',
    when: hasScene,
    run: (c) => walkTo(c, 1),
  },
  {
    id: 'previous-agent',
    label: 'Previous road user',
    keys: ['Shift+Tab'],
    help: 'The way back',
    when: hasScene,
    run: (c) => walkTo(c, -1),
  },
  {
    id: 'fit',
    label: 'Fit the scene',
    keys: ['0'],
    icon: 'fit',
    help: 'The whole map in view',
    when: hasScene,
    run: (c) => c.fit(),
  },
  {
    id: 'back-to-scene',
    label: 'Back to the scene',
    icon: 'fit',
    help: 'Where things move',
    when: hasScene,
    run: (c) => c.lookAtScene(),
  },
  {
    id: 'zoom-selection',
    label: 'Zoom to selection',
    keys: ['Z'],
    icon: 'search',
    help: 'The selected road user and its goal',
    when: hasAgent,
    run: zoomToSelection,
  },
  {
    id: 'zoom-in',
    label: 'Zoom in',
    keys: ['PageUp'],
    icon: 'plus',
    help: 'A third closer',
    run: (c) => zoom(c, 1.33),
  },
  {
    id: 'zoom-out',
    label: 'Zoom out',
    keys: ['PageDown'],
    icon: 'minus',
    help: 'A third further',
    run: (c) => zoom(c, 1 / 1.33),
  },
  {
    id: 'follow',
    label: 'Keep in view',
    keys: ['K'],
    icon: 'eye',
    help: 'The picture follows the selected road user in playback',
    when: hasAgent,
    checked: (c) => c.editor.playhead.follow.value,
    run: (c) => c.editor.playhead.toggleFollow(),
  },
  {
    id: 'others-answers',
    label: 'The others’ answers',
    keys: ['H'],
    help: 'Where the others would wait, shown or hidden while a handle is dragged',
    whileDragging: true,
    checked: (c) => c.editor.showForeseen.value,
    run: (c) => c.editor.toggleForeseen(),
  },
  layer('futures', 'Futures', 'Shift+O', 'Where everybody may go'),
  layer('log', 'Log', 'O', 'What was recorded, dashed'),
  layer('lanes', 'Lanes', 'Shift+K', 'Centre lines of the lanes'),
  layer('labels', 'Labels', 'Shift+L', 'Names of the road users'),
]);
