// Traffic signals at the stop line. Red is a solid bar, green a row of dots, so that colour is not needed.
import type { Pen } from './pen';
import { pointAt, type Vec } from '../model/base/geometry';
import type { Scene } from '../model/document/scene';
import { lightAt, stopOf, type Light } from '../model/physics/signals';
import { colours } from './theme';
import type { View } from './view';

export function paintSignals(g: Pen, v: View, scene: Scene, t: number): void {
  if (v.z < 3) return;
  const c = colours();
  const paint: Record<Light, string> = { stop: c.collision, caution: c.near, go: c.ok, unknown: c['ink-3'] };
  const done = new Set<string>();
  for (const s of scene.signals) {
    const lane = scene.map.lanes.get(s.lane);
    const at = stopOf(s, lane);
    if (!at || (lane && lane.kind === 'walk')) continue;
    // Several turns share one stop line; one bar for each lane is enough.
    const key = `${Math.round(at[0] * 2)},${Math.round(at[1] * 2)}`;
    if (done.has(key)) continue;
    done.add(key);
    const light = lightAt(s, t);
    if (!lane) {
      // A pedestrian signal, or one whose lane is not on the map: no direction, so a disc.
      disc(g, ...v.to(at[0], at[1]), Math.max(3.2, 0.4 * v.z), light, paint[light]);
      continue;
    }
    const entry = pointAt(lane.line, 0);
    const nearStart = Math.hypot(entry.x - at[0], entry.y - at[1]) < lane.line.length / 2;
    const heading = pointAt(lane.line, nearStart ? 0 : lane.line.length).heading;
    bar(
      g,
      ...v.to(at[0], at[1]),
      v.ahead(heading),
      Math.max(9, Math.min(2.5, lane.width - 0.7) * v.z),
      Math.max(3, 0.32 * v.z),
      light,
      paint[light],
    );
  }
}

function bar(
  g: Pen,
  x: number,
  y: number,
  [right, down]: Vec,
  length: number,
  thick: number,
  light: Light,
  colour: string,
): void {
  // Across the lane.
  const dx = (-down * length) / 2,
    dy = (right * length) / 2;
  g.beginPath();
  g.moveTo(x - dx, y - dy);
  g.lineTo(x + dx, y + dy);
  g.lineCap = 'round';
  g.strokeStyle = colours()['map-asphalt'];
  g.lineWidth = thick + 2;
  g.setLineDash([]);
  if (light !== 'go') g.stroke();
  g.strokeStyle = colour;
  g.lineWidth = thick;
  if (light === 'go') g.setLineDash([0.01, thick * 1.75]);
  if (light === 'unknown') {
    g.setLineDash([thick, thick * 1.4]);
    g.globalAlpha = 0.7;
  }
  g.stroke();
  g.setLineDash([]);
  g.globalAlpha = 1;
}

function disc(g: Pen, x: number, y: number, r: number, light: Light, colour: string): void {
  const c = colours();
  g.beginPath();
  g.arc(x, y, Math.min(r, 6), 0, Math.PI * 2);
  g.fillStyle = colour;
  g.strokeStyle = c.halo;
  g.lineWidth = 1.5;
  g.setLineDash([]);
  g.stroke();
  g.fill();
  if (light !== 'go') return;
  g.beginPath();
  g.arc(x, y, Math.min(r, 6) * 0.42, 0, Math.PI * 2);
  g.fillStyle = c.halo;
  g.fill();
}
