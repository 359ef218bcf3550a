// The default tool: clicks select, drags move handles and boxes, and elsewhere the picture.
import { takePin } from '../../model/document/pins';
import { canChange, startPose, type Agent } from '../../model/document/scene';
import { freeOnes, lockedWords } from '../moves/copying';
import type { Grip } from '../session/drag';
import { takeFuture } from '../moves/moves';
import { addVia, roomForVia } from '../moves/vias';
import { roadWay } from '../moves/ways-out';
import type { Chart, FrameHandle, Press, State, Tool } from './chart';
import { DraggingCopies } from './dragging-copies';
import { DraggingHandle, type Move } from './dragging-handle';
import { DraggingSeveral } from './dragging-several';
import { SIGNAL_PX } from './hit';
import { HandleMove } from './handle-move';
import { itemOnMap, itemWords } from './on-the-map';
import { Panning } from './panning';
import { ghostHere, placeGhost } from './placing';
import { rectangle, Sweeping } from './sweeping';
import { TEXTS } from '../../texts/desk/gestures';
import { ViaMove } from './via-move';

/** Assumed distance of the goal ahead of a road user without futures, in metres. */
const GOAL_AHEAD_M = 20;
/** Time that words about the map stay. */
const TOLD_MS = 3000;

export const SELECT: Tool = {
  name: 'select',
  label: TEXTS.selectAndDrag,
  key: 'V',
  icon: 'select',
  help: 'clickARoad',
  cursor: '',
  picks: true,
  hover,
  drag,
  click,
};

/** On a map without road users a car is offered on any lane. */
function hover(chart: Chart): void {
  const { editor, placement } = chart;
  if (editor.scene.peek()?.agents.size !== 0) {
    if (placement.ghosts.peek()) placement.show(null);
    return;
  }
  ghostHere(chart, 'car');
  if (!placement.ghosts.peek()?.lane) placement.show(null);
}

function drag(chart: Chart, press: Press): State {
  const { editor, modifiers } = chart;
  const { hit } = press;
  const scene = editor.scene.peek();
  if (!scene) return new Panning(chart, press);
  if (hit.kind === 'frame') return several(chart, press, hit.handle);
  if (hit.kind === 'handle') return hit.handle.drag(chart, press);
  const body = bodyUnder(chart, press);
  if (body !== null) {
    const among = editor.selected.peek().includes(body);
    if (!among) editor.select(body);
    if (modifiers.alt) return new DraggingCopies(chart, press, editor.chosenOnes);
    if (editor.selected.peek().length > 1) return several(chart, press, 'move');
  }
  const grip = body !== null ? START_BODY : hit.kind === 'grip' ? hit.grip : null;
  if (grip && editor.agent.peek()?.locked) return new LockedPress(chart);
  const move = grip && handleMove(chart, press, grip);
  if (move) return new DraggingHandle(chart, press, move);
  return press.touch ? new Panning(chart, press) : new Sweeping('marquee', chart, press, rectangle);
}

const START_BODY: Grip = { part: 'start', handle: 'body' };

function several(chart: Chart, press: Press, what: FrameHandle): State {
  const free = freeOnes(chart.editor);
  return free.length ? new DraggingSeveral(chart, press, free, what) : new LockedPress(chart, false);
}

/**
 * At the start of the scene the box of a road user is the handle of its start. A finger beside the box moves the
 * picture, since some road user is always near.
 */
function bodyUnder({ editor }: Chart, { hit }: Press): string | null {
  if (editor.playhead.time.peek() >= 0.05) return null;
  if (hit.kind === 'agent') return hit.beside ? null : hit.id;
  const start = hit.kind === 'grip' && hit.grip.part === 'start' && hit.grip.handle === 'body';
  return start ? editor.selection.peek() : null;
}

/** A locked road user does not move; a notice explains why. */
class LockedPress implements State {
  readonly name = 'refused';
  constructor(
    private readonly chart: Chart,
    private readonly say = true,
  ) {}

  enter(): void {
    const { notices } = this.chart.editor;
    if (!this.say) return;
    notices.show({ text: lockedWords(1) });
    notices.say(lockedWords(1));
  }

  up(): void {
    this.chart.rest();
  }
}

function handleMove({ editor, surface }: Chart, press: Press, grip: Grip): Move | null {
  const agent = editor.agent.peek();
  const start = agent && startPose(agent);
  if (!agent || !start || !canChange(agent)) return null;
  if (grip.index !== undefined) return new ViaMove(editor, surface.view, grip, agent, press);
  const goal = editor.reading.goalPose(agent) ?? {
    ...start,
    x: start.x + Math.cos(start.heading) * GOAL_AHEAD_M,
    y: start.y + Math.sin(start.heading) * GOAL_AHEAD_M,
  };
  return new HandleMove(editor, surface.view, { grip, agent, start, goal, press });
}

/** Adds a via point at the pressed place of the future. */
function putVia({ editor, surface }: Chart, a: Agent, press: Press, future: number): void {
  const added = addVia(editor, a, surface.view.from(press.x, press.y), future);
  const room = roomForVia(a);
  if (room !== true) editor.notices.show({ text: room });
  if (!added) return;
  editor.commits.run(added.command);
  editor.takeVia(added.index);
}

/** With nothing selected a click picks what is there: the panel has it. A finger covers that panel, and gets words. */
function pickOnMap({ editor, surface }: Chart, press: Press): void {
  const scene = editor.scene.peek();
  const item =
    scene && itemOnMap(scene, surface.view.from(press.x, press.y), press.touch ? SIGNAL_PX / surface.view.z : 0);
  editor.pickOnMap(item);
  if (!item) return;
  const words = itemWords(scene, item, editor.playhead.time.peek());
  if (press.touch) editor.notices.show({ text: words }, TOLD_MS);
  editor.notices.say(words);
}

/** Room for a flag and its label, pixels. */
const FLAG_ROOM_PX = 70;

/** Moves the picture just far enough to show the flag. */
function lookAtGoal({ editor, surface }: Chart): void {
  const a = editor.agent.peek();
  const goal = a && editor.reading.goalPose(a);
  if (!goal) return;
  const [x, y] = surface.view.to(goal.x, goal.y);
  surface.view.panInto({ x0: x, x1: x, y0: y, y1: y }, FLAG_ROOM_PX);
  surface.viewChanged();
}

export function click(chart: Chart, press: Press, timeStamp: number): void {
  const { editor } = chart;
  const { hit } = press;
  const a = editor.agent.peek();
  const adds = chart.modifiers.shift;
  // When adding to the selection, a road user wins over handles and futures of the selected one.
  const over = adds && (hit.kind === 'grip' || hit.kind === 'future');
  const other = over ? chart.parts.agentsAt(press).find((id) => id !== a?.id) : undefined;
  if (other !== undefined) {
    editor.playhead.pause();
    editor.toggleSelected(other);
    return;
  }
  switch (hit.kind) {
    case 'agent':
      editor.playhead.pause();
      if (adds) editor.toggleSelected(hit.id);
      else editor.select(chart.pile.take(hit.pile, timeStamp));
      break;
    case 'pennant':
      if (adds) editor.toggleSelected(hit.id);
      else editor.select(hit.id);
      break;
    case 'handle':
      hit.handle.click();
      break;
    case 'frame':
      break;
    case 'future': {
      if (a && editor.reading.cards.ofAgent(a.id)) {
        editor.reading.cards.point(hit.index);
        break;
      }
      if (adds && a && !a.locked) {
        putVia(chart, a, press, hit.index);
        break;
      }
      if (a) takeFuture(editor, a, hit.index);
      break;
    }
    case 'pinned':
      if (a && !a.locked) editor.commits.run(takePin(a, hit.pin));
      break;
    case 'by-road': {
      const way = a && !a.locked && roadWay(editor, a);
      if (way) editor.commits.run(way.command);
      break;
    }
    case 'grip': {
      if (adds && a && hit.grip.index === undefined) {
        editor.toggleSelected(a.id);
        break;
      }
      editor.activate(hit.grip.part);
      if (hit.grip.edge) lookAtGoal(chart);
      editor.takeVia(hit.grip.index ?? null);
      const box = hit.grip.part === 'start' && hit.grip.handle === 'body';
      const below = box ? chart.parts.agentsAt(press) : [];
      if (below.length > 1) editor.select(chart.pile.take(below, timeStamp));
      break;
    }
    case 'none':
      if (chart.placement.ghosts.peek()) placeGhost(editor, chart.placement);
      else if (!adds) {
        const some = editor.selected.peek().length > 0;
        editor.select(null);
        if (!some) pickOnMap(chart, press);
      }
  }
}
