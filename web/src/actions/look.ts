// Select and look: tools, who is selected, the view, the layers.
import { boxOf } from '../model/geometry';
import { nearestLanes } from '../model/lanemap';
import { canChange, startPose, type Agent } from '../model/scene';
import { knowsLimits } from '../draw/ground';
import { TOOLS } from '../edit/gestures/tools';
import type { LayerName } from '../edit/layers';
import { lanesFor } from '../edit/snap';
import { hasAgent, hasScene, hasSome, inGroup, type Action } from './action';
import { selectedWords } from './edit';
import type { Context } from './context';

/** Metres of road shown around the selected road user and its goal, and the closest that "zoom to" goes. */
const AROUND_M = 18;
const CLOSEST = 22;
/** So far from the middle of a lane one still stands on it. */
const ON_LANE_M = 2.2;

const tools = TOOLS.filter((t) => !('places' in t)).map(({ name, label, key, icon, help }) => ({
  id: `tool-${name}`,
  label,
  keys: [key],
  icon,
  help,
  checked: (c: Context) => c.editor.tool.value === name,
  run(c: Context): void {
    c.editor.chooseTool(name);
    if (name !== 'fill') return;
    // Whoever comes starts at 0 s; the panel stands where the lists do.
    c.editor.playhead.pause();
    c.editor.setTime(0);
    c.ui.showDrawer(null);
  },
}));

/** Ids of those who can be changed, nearest to the middle of the picture first. */
function nearestFirst(c: Context): string[] {
  const v = c.stage.view;
  const [x, y] = v.from(v.w / 2, v.h / 2);
  return [...(c.editor.scene.value?.agents.values() ?? [])]
    .filter(canChange)
    .map((a) => ({ id: a.id, d: Math.hypot((startPose(a)?.x ?? 0) - x, (startPose(a)?.y ?? 0) - y) }))
    .sort((p, q) => p.d - q.d)
    .map((p) => p.id);
}

let walk: { ids: string[]; cast: string } | null = null;

function walkTo(c: Context, step: 1 | -1): void {
  const cast = `${c.editor.scene.value?.id} ${c.editor.scene.value?.roster}`;
  const selected = c.editor.selection.value;
  // The order is kept while one walks, or the next key would jump back to the middle.
  if (!walk || walk.cast !== cast || !selected) walk = { ids: nearestFirst(c), cast };
  const { ids } = walk;
  const at = ids.indexOf(selected ?? '');
  const id = ids[at < 0 ? (step > 0 ? 0 : ids.length - 1) : (at + step + ids.length) % ids.length];
  if (!id) return;
  c.editor.select(id);
  c.reveal([id]);
  c.focusAgent(id);
}

/** Is the walk through the road users at its end in this direction? Then Tab leaves them. */
export function walkEnds(c: Context, step: 1 | -1): boolean {
  const selected = c.editor.selection.peek();
  return selected !== null && (step > 0 ? walk?.ids.at(-1) : walk?.ids[0]) === selected;
}

/** Everybody who takes part in the traffic. */
const all = (c: Context): Agent[] =>
  [...(c.editor.scene.value?.agents.values() ?? [])].filter((a) => a.type !== 'other');

function selectWhere(c: Context, which: (a: Agent) => boolean, none: string): void {
  const ids = all(c)
    .filter(which)
    .map((a) => a.id);
  if (!ids.length) {
    c.editor.notices.show({ text: none });
    return;
  }
  c.editor.selectAll(ids);
  c.editor.notices.show({ text: `${selectedWords(c)} selected.` });
}

/** Lanes that the selected ones stand on. */
function lanesOf(c: Context, a: Agent): string[] {
  const p = startPose(a);
  const fits = lanesFor(a) ?? (() => true);
  const hit = p && nearestLanes(c.editor.scene.value!.map, p.x, p.y, p.heading, ON_LANE_M, fits)[0];
  return hit ? [hit.lane.id] : [];
}

function selectLane(c: Context): void {
  const lanes = new Set(c.editor.chosenOnes.flatMap((a) => lanesOf(c, a)));
  if (!lanes.size) {
    c.editor.notices.show({ text: 'Nobody who is selected stands on a lane.' });
    return;
  }
  selectWhere(c, (a) => lanesOf(c, a).some((id) => lanes.has(id)), '');
}

/** Those who would be hit by the selected ones, or come close to them. */
function selectConflicts(c: Context): void {
  const mine = new Set(c.editor.selected.value);
  const met = new Set<string>();
  for (const e of c.editor.events.value) {
    if (!e.b) continue;
    if (mine.has(e.a.id)) met.add(e.b.id);
    if (mine.has(e.b.id)) met.add(e.a.id);
  }
  selectWhere(c, (a) => mine.has(a.id) || met.has(a.id), '');
}

function zoom(c: Context, factor: number): void {
  c.stage.glide.by((v) => v.zoomAt(v.w / 2, v.h / 2, factor));
}

function zoomToSelection(c: Context): void {
  const places = c.editor.chosenOnes.flatMap((a) => {
    const p = startPose(a);
    return p ? [p, c.editor.goalPose(a) ?? p] : [];
  });
  if (!places.length) return;
  const box = boxOf(places.map((p) => [p.x, p.y] as const));
  const grown = { x0: box.x0 - AROUND_M, x1: box.x1 + AROUND_M, y0: box.y0 - AROUND_M, y1: box.y1 + AROUND_M };
  c.stage.glide.by((v) => v.fit(grown, CLOSEST));
}

const layer = (
  name: LayerName,
  label: string,
  key: string,
  help: string,
  when: Action['when'] = hasScene,
): Omit<Action, 'group'> => ({
  id: `layer-${name}`,
  label,
  keys: [key],
  help,
  when,
  checked: (c) => c.editor.layers.value[name],
  run: (c) => c.editor.toggleLayer(name),
});

export const look = inGroup('Select and look', [
  ...tools,
  {
    id: 'select-all',
    label: 'Select everybody',
    keys: ['Ctrl+A'],
    icon: 'select-all',
    help: 'All road users in the scene',
    when: hasScene,
    run: (c) => selectWhere(c, () => true, 'Nobody is here yet.'),
  },
  {
    id: 'select-kind',
    label: 'Select all of this kind',
    keys: ['Shift+A'],
    icon: 'select-all',
    help: 'All that are of the kind of the selected ones',
    when: hasSome,
    run(c) {
      const kinds = new Set(c.editor.chosenOnes.map((a) => a.kind));
      selectWhere(c, (a) => kinds.has(a.kind), '');
    },
  },
  {
    id: 'select-lane',
    label: 'Select all on this lane',
    keys: ['Alt+A'],
    icon: 'layers',
    help: 'All that start on the lanes of the selected ones',
    when: hasSome,
    run: selectLane,
  },
  {
    id: 'select-conflicts',
    label: 'Select who meets them',
    keys: ['Alt+Shift+A'],
    icon: 'warn',
    help: 'All that collide or nearly collide with the selected ones',
    when: hasSome,
    run: selectConflicts,
  },
  {
    id: 'select-others',
    label: 'Select the others instead',
    keys: ['Ctrl+Shift+A'],
    icon: 'invert',
    help: 'Everybody who is not selected now',
    when: hasScene,
    run(c) {
      const now = new Set(c.editor.selected.value);
      selectWhere(c, (a) => !now.has(a.id), 'Everybody is selected already.');
    },
  },
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
    help: 'The selected road users and their goals',
    when: hasSome,
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
  layer('lanes', 'Lanes', 'Shift+W', 'Centre lines of the lanes'),
  layer('labels', 'Labels', 'Shift+L', 'Names of the road users'),
  layer('signals', 'Signals', 'Shift+S', 'Lights at the stop lines, as they are at the playhead'),
  layer('limits', 'Speed limits', 'Shift+M', 'What the map allows on its lanes', (c) => {
    const scene = c.editor.scene.value;
    return !scene || knowsLimits(scene.map) ? hasScene(c) : 'This map knows no speed limits.';
  }),
  layer('reach', 'Reach', 'Shift+H', 'Where the selected road user can be at the goal time, along the lanes'),
  layer('conflicts', 'Conflict zones', 'Shift+C', 'Where ways cross within 3 s of each other; the darker, the closer'),
]);
