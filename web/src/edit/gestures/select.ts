// The tool one starts with: clicks select, drags take hold of handles and boxes, and of the picture elsewhere.
import { canChange, startPose } from '../../model/scene';
import type { Grip } from '../editor';
import { pickFuture } from '../moves';
import { roadWay } from '../ways-out';
import type { Chart, State } from './chart';
import { DraggingHandle } from './dragging-handle';
import { HandleMove } from './handle-move';
import { Panning } from './panning';
import type { Press } from './pressed';

/** How far ahead of a road user without futures its goal is taken to be, in metres. */
const GOAL_AHEAD_M = 20;

export const SELECT = {
  name: 'select' as const,
  label: 'Select and drag',
  key: 'V',
  icon: 'select',
  help: 'Click a road user, drag its handles',
  cursor: '',
  picks: true,
  drag,
  click,
};

function drag(chart: Chart, press: Press): State {
  const grip = gripOf(chart, press);
  const move = grip && handleMove(chart, press, grip);
  return move ? new DraggingHandle(chart, press, move) : new Panning(chart, press);
}

/** At the start of the scene a road user itself is the handle of its start. */
function gripOf({ editor }: Chart, { hit }: Press): Grip | null {
  if (hit.kind === 'grip') return hit.grip;
  if (hit.kind !== 'agent' || editor.time.peek() >= 0.05) return null;
  editor.select(hit.id);
  return { part: 'start', handle: 'body' };
}

function handleMove({ editor, surface }: Chart, press: Press, grip: Grip): HandleMove | null {
  const agent = editor.agent.peek();
  const start = agent && startPose(agent);
  if (!agent || !start || !canChange(agent)) return null;
  const goal = editor.goalPose(agent) ?? {
    ...start,
    x: start.x + Math.cos(start.heading) * GOAL_AHEAD_M,
    y: start.y + Math.sin(start.heading) * GOAL_AHEAD_M,
  };
  return new HandleMove(editor, surface.view, { grip, agent, start, goal, press });
}

function click(chart: Chart, press: Press, timeStamp: number): void {
  const { editor } = chart;
  const { hit } = press;
  const a = editor.agent.peek();
  switch (hit.kind) {
    case 'agent':
      editor.playhead.pause();
      editor.select(chart.pile.take(hit.pile, timeStamp));
      break;
    case 'future': {
      const command = a && a.chosen !== hit.index ? pickFuture(editor, a, hit.index) : null;
      if (command) editor.run(command);
      break;
    }
    case 'by road': {
      const way = a && roadWay(editor, a);
      if (way) editor.run(way.command);
      break;
    }
    case 'grip': {
      editor.activate(hit.grip.part);
      const box = hit.grip.part === 'start' && hit.grip.handle === 'body';
      const below = box ? chart.parts.agentsAt(press) : [];
      if (below.length > 1) editor.select(chart.pile.take(below, timeStamp));
      break;
    }
    case 'none':
      editor.select(null);
  }
}
