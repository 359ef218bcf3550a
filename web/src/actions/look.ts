// Select and look: tools, selection, view, layers.
import type { Help } from '../texts/desk/helps';
import { JUDGING } from '../model/base/domain';
import { nearestLanes } from '../model/document/lanemap';
import { canChange, startPose, type Agent } from '../model/document/scene';
import { knowsLimits } from '../draw/ground';
import { RAIL } from '../edit/tools/tools';
import type { LayerName } from '../edit/session/view-settings';
import { lanesFor } from '../edit/moves/snap';
import { hasAgent, hasScene, hasSome, inGroup, type Action } from './action';
import { selectedWords } from './edit';
import type { Context } from './context';
import { AROUND_M, placesOfSelected, turning } from './turning';
import { TEXTS } from '../texts/desk/actions';

/** Closest zoom of "zoom to". */
const CLOSEST = 22;

const tools = RAIL.filter((t) => !t.places).map(({ name, label, key, icon, help }) => ({
  id: `tool-${name}`,
  label,
  keys: [key],
  icon,
  help,
  checked: (c: Context) => c.editor.tool.value === name,
  run(c: Context): void {
    c.editor.chooseTool(name);
    if (name !== 'fill') return;
    // New road users start at 0 s; the panel takes the place of the lists.
    c.editor.playhead.pause();
    c.editor.playhead.moveTo(0);
    c.ui.showDrawer(null);
  },
}));

/** Ids of changeable road users, nearest to the middle of the picture first. */
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
  const cast = `${c.editor.scene.value?.id} ${c.editor.scene.value?.castKey}`;
  const selected = c.editor.selection.value;
  // The order is kept during the walk, or the next key would jump back to the middle.
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

/** All road users in traffic. */
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
  c.editor.notices.show({ text: TEXTS.selected(selectedWords(c)) });
}

/** Lanes under the selected road users. */
function lanesOf(c: Context, a: Agent): string[] {
  const p = startPose(a);
  const fits = lanesFor(a) ?? (() => true);
  const hit = p && nearestLanes(c.editor.scene.value!.map, p.x, p.y, p.heading, JUDGING.on_lane_m, fits)[0];
  return hit ? [hit.lane.id] : [];
}

function selectLane(c: Context): void {
  const lanes = new Set(c.editor.chosenOnes.flatMap((a) => lanesOf(c, a)));
  if (!lanes.size) {
    c.editor.notices.show({ text: TEXTS.noneIsOnALane });
    return;
  }
  selectWhere(c, (a) => lanesOf(c, a).some((id) => lanes.has(id)), '');
}

/** Selects road users with a collision or near miss with the selected ones. */
function selectConflicts(c: Context): void {
  const mine = new Set(c.editor.selected.value);
  const met = new Set<string>();
  for (const e of c.editor.reading.events.value) {
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
  const places = placesOfSelected(c.editor);
  if (places.length) c.stage.glide.by((v) => v.fitPlaces(places, AROUND_M, CLOSEST));
}

const layer = (
  name: LayerName,
  label: string,
  key: string,
  help: Help,
  when: Action['when'] = hasScene,
): Omit<Action, 'group'> => ({
  id: `layer-${name}`,
  label,
  keys: [key],
  help,
  when,
  checked: (c) => c.editor.view.layers.value[name],
  run: (c) => c.editor.view.toggleLayer(name),
});

const called = (...names: string[]): typeof tools => tools.filter((t) => names.includes(t.id));

const filling = inGroup('place', called('tool-fill'));

const selecting = inGroup('select', [
  ...called('tool-select', 'tool-lasso'),
  {
    id: 'select-all',
    label: TEXTS.selectAll,
    keys: ['Ctrl+A'],
    icon: 'select-all',
    help: 'allRoadUsers',
    when: hasScene,
    run: (c) => selectWhere(c, () => true, TEXTS.noRoadUsersYet),
  },
  {
    id: 'select-kind',
    label: TEXTS.selectAllOfThis,
    keys: ['Shift+A'],
    icon: 'select-all',
    help: 'allOfTheTypes',
    when: hasSome,
    run(c) {
      const kinds = new Set(c.editor.chosenOnes.map((a) => a.kind));
      selectWhere(c, (a) => kinds.has(a.kind), '');
    },
  },
  {
    id: 'select-lane',
    label: TEXTS.selectAllOnThis,
    keys: ['Alt+A'],
    icon: 'layers',
    help: 'allThatStart',
    when: hasSome,
    run: selectLane,
  },
  {
    id: 'select-conflicts',
    label: TEXTS.selectConflicting,
    keys: ['Alt+Shift+A'],
    icon: 'warn',
    help: 'allThatCollide',
    when: hasSome,
    run: selectConflicts,
  },
  {
    id: 'select-others',
    label: TEXTS.invertSelection,
    keys: ['Ctrl+Shift+A'],
    icon: 'invert',
    help: 'allNotSelected',
    when: hasScene,
    run(c) {
      const now = new Set(c.editor.selected.value);
      selectWhere(c, (a) => !now.has(a.id), TEXTS.allAreSelected);
    },
  },
  {
    id: 'next-agent',
    label: TEXTS.nextRoadUser,
    keys: ['Tab'],
    help: 'nearestToThe',
    when: hasScene,
    run: (c) => walkTo(c, 1),
  },
  {
    id: 'previous-agent',
    label: TEXTS.previousRoad,
    keys: ['Shift+Tab'],
    help: 'inReverseOrder',
    when: hasScene,
    run: (c) => walkTo(c, -1),
  },
]);

const looking = inGroup('look', [
  ...called('tool-pan', 'tool-measure'),
  {
    id: 'fit',
    label: TEXTS.fitTheScene,
    keys: ['0', 'Ctrl+0'],
    icon: 'fit',
    help: 'theWholeMap',
    when: hasScene,
    run: (c) => c.fit(),
  },
  {
    id: 'back-to-scene',
    label: TEXTS.backToTheScene,
    icon: 'fit',
    help: 'theAreaWithTraffic',
    when: hasScene,
    run: (c) => c.lookAtScene(),
  },
  {
    id: 'zoom-selection',
    label: TEXTS.zoomToSelection,
    keys: ['Z'],
    icon: 'search',
    help: 'theSelectedRoad',
    when: hasSome,
    run: zoomToSelection,
  },
  {
    id: 'zoom-in',
    label: TEXTS.zoomIn,
    keys: ['PageUp', 'Ctrl++'],
    icon: 'plus',
    help: 'byOneThird',
    run: (c) => zoom(c, 1.33),
  },
  {
    id: 'zoom-out',
    label: TEXTS.zoomOut,
    keys: ['PageDown', 'Ctrl+-'],
    icon: 'minus',
    help: 'aThirdFurther',
    run: (c) => zoom(c, 1 / 1.33),
  },
  ...turning,
  {
    id: 'follow',
    label: TEXTS.keepInView,
    keys: ['K'],
    icon: 'eye',
    help: 'theViewFollows',
    when: hasAgent,
    checked: (c) => c.editor.playhead.follow.value,
    run: (c) => c.editor.playhead.toggleFollow(),
  },
  {
    id: 'others-answers',
    label: TEXTS.othersReactions,
    keys: ['H'],
    help: 'whereOthersWouldWait',
    whileDragging: true,
    checked: (c) => c.editor.view.showPreviewed.value,
    run: (c) => c.editor.view.togglePreviewed(),
  },
  layer('futures', TEXTS.futures, 'Shift+O', 'thePossiblePaths'),
  layer('log', TEXTS.log, 'O', 'theRecordedTracks'),
  layer('lanes', TEXTS.lanes, 'Shift+W', 'centreLines'),
  layer('labels', TEXTS.labels, 'Shift+L', 'namesOfThe'),
  layer('signals', TEXTS.signals, 'Shift+S', 'signalStates'),
  layer('limits', TEXTS.speedLimits, 'Shift+M', 'speedLimitsOfTheLanes', (c) => {
    const scene = c.editor.scene.value;
    return !scene || knowsLimits(scene.map) ? hasScene(c) : TEXTS.thisMapKnows;
  }),
  layer('reach', TEXTS.reach, 'Shift+H', 'whereTheSelected'),
  layer('conflicts', TEXTS.conflictZones, 'Shift+C', 'whereWaysCross'),
]);

export const look = [...selecting, ...looking, ...filling];
