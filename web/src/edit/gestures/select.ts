// The tool one starts with: clicks select, drags take hold of handles and boxes, and of the picture elsewhere.
import { takePin } from '../../model/document/pins';
import { canChange, startPose, type Agent } from '../../model/document/scene';
import { freeOnes, lockedWords } from '../copying';
import type { Grip } from '../editor';
import type { FrameHandle } from '../hit';
import { takeFuture } from '../moves';
import { addVia, roomForVia } from '../vias';
import { roadWay } from '../ways-out';
import type { Chart, State } from './chart';
import { DraggingCopies } from './dragging-copies';
import { DraggingHandle, type Move } from './dragging-handle';
import { DraggingSeveral } from './dragging-several';
import { DraggingHold, DraggingStop } from './dragging-stop';
import { HandleMove } from './handle-move';
import { Panning } from './panning';
import { ghostHere, placeGhost } from './placing';
import type { Press } from './pressed';
import { rectangle, Sweeping } from './sweeping';
import { TEXTS } from '../../texts/desk/gestures';
import { ViaMove } from './via-move';

/** How far ahead of a road user without futures its goal is taken to be, in metres. */
const GOAL_AHEAD_M = 20;

export const SELECT = {
  name: 'select' as const,
  label: TEXTS.selectAndDrag,
  key: 'V',
  icon: 'select',
  help: 'clickARoad' as const,
  cursor: '',
  picks: true,
  hover,
  drag,
  click,
};

/** On a map with nobody on it a car is offered wherever there is a lane. */
function hover(chart: Chart): void {
  const { placement, scene } = chart.editor;
  if (scene.peek()?.agents.size !== 0) {
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
  if (hit.kind === 'stop') return new DraggingStop(chart, hit.point);
  if (hit.kind === 'hold') return new DraggingHold(chart, hit.point, press.x);
  const body = bodyUnder(chart, press);
  if (body !== null) {
    const among = editor.selected.peek().includes(body);
    if (!among) editor.select(body);
    if (modifiers.alt) return new DraggingCopies(chart, press, editor.chosenOnes);
    if (editor.selected.peek().length > 1) return several(chart, press, 'move');
  }
  const grip = body !== null ? START_BODY : hit.kind === 'grip' ? hit.grip : null;
  if (grip && editor.agent.peek()?.locked) return new Refused(chart);
  const move = grip && handleMove(chart, press, grip);
  if (move) return new DraggingHandle(chart, press, move);
  return press.touch ? new Panning(chart, press) : new Sweeping('marquee', chart, press, rectangle);
}

const START_BODY: Grip = { part: 'start', handle: 'body' };

function several(chart: Chart, press: Press, what: FrameHandle): State {
  const free = freeOnes(chart.editor);
  return free.length ? new DraggingSeveral(chart, press, free, what) : new Refused(chart, false);
}

/**
 * At the start of the scene a road user itself is the handle of its start. A finger beside it moves the picture: there
 * is always somebody near.
 */
function bodyUnder({ editor }: Chart, { hit }: Press): string | null {
  if (editor.time.peek() >= 0.05) return null;
  if (hit.kind === 'agent') return hit.beside ? null : hit.id;
  const start = hit.kind === 'grip' && hit.grip.part === 'start' && hit.grip.handle === 'body';
  return start ? editor.selection.peek() : null;
}

/** What is locked stays where it is, and says so. */
class Refused implements State {
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
  const goal = editor.goalPose(agent) ?? {
    ...start,
    x: start.x + Math.cos(start.heading) * GOAL_AHEAD_M,
    y: start.y + Math.sin(start.heading) * GOAL_AHEAD_M,
  };
  return new HandleMove(editor, surface.view, { grip, agent, start, goal, press });
}

/** A via point where the future was pressed. */
function putVia({ editor, surface }: Chart, a: Agent, press: Press, future: number): void {
  const added = addVia(editor, a, surface.view.from(press.x, press.y), future);
  const room = roomForVia(a);
  if (room !== true) editor.notices.show({ text: room });
  if (!added) return;
  editor.run(added.command);
  editor.takeVia(added.index);
}

export function click(chart: Chart, press: Press, timeStamp: number): void {
  const { editor } = chart;
  const { hit } = press;
  const a = editor.agent.peek();
  const adds = chart.modifiers.shift;
  // Whoever adds to what is selected means the road user, not what of the selected one lies over it.
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
    case 'stop':
    case 'hold':
      editor.curve.take(hit.point);
      break;
    case 'frame':
      break;
    case 'future': {
      if (a && editor.deck.ofAgent(a.id)) {
        editor.deck.point(hit.index);
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
      if (a && !a.locked) editor.run(takePin(a, hit.pin));
      break;
    case 'by-road': {
      const way = a && !a.locked && roadWay(editor, a);
      if (way) editor.run(way.command);
      break;
    }
    case 'grip': {
      if (adds && a && hit.grip.index === undefined) {
        editor.toggleSelected(a.id);
        break;
      }
      editor.activate(hit.grip.part);
      editor.takeVia(hit.grip.index ?? null);
      const box = hit.grip.part === 'start' && hit.grip.handle === 'body';
      const below = box ? chart.parts.agentsAt(press) : [];
      if (below.length > 1) editor.select(chart.pile.take(below, timeStamp));
      break;
    }
    case 'none':
      if (editor.placement.ghosts.peek()) placeGhost(editor);
      else if (!adds) editor.select(null);
  }
}
