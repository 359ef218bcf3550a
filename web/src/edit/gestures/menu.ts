// The right button, and a resting finger: a menu for the object there. Dragged, the right button moves the picture.
import type { Chart, Press, Tool } from './chart';
import { PAN } from './panning';

/** Selects the pressed object and opens its menu. */
export function ask(chart: Chart, { x, y, hit }: Press): void {
  const { editor } = chart;
  const id = hit.kind === 'agent' || hit.kind === 'pennant' ? hit.id : null;
  if (id && !editor.selected.peek().includes(id)) editor.select(id);
  editor.takeVia(hit.kind === 'grip' ? (hit.grip.index ?? null) : null);
  const on = hit.kind === 'pennant' || (hit.kind === 'grip' && hit.grip.part === 'goal') ? 'goal' : null;
  const some = id !== null || hit.kind === 'grip' || hit.kind === 'frame';
  const who = !some ? 'ground' : editor.selected.peek().length > 1 ? 'several' : 'road-user';
  const future = hit.kind === 'future' ? hit.index : null;
  chart.parts.menu({ x, y }, on ?? (future === null ? who : 'future'), future);
}

export const ASK: Tool = { ...PAN, picks: true, click: (chart, press) => ask(chart, press) };
