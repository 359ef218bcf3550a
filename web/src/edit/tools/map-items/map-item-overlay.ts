// The picked part of the map: its lane, its outline, or the stop lines of its signal group.
import type { Pen } from '../../../draw/pen';
import { polyline } from '../../../draw/strokes';
import { colours } from '../../../draw/theme';
import type { View } from '../../../draw/view';
import type { Vec } from '../../../model/base/geometry';
import { stopOf } from '../../../model/physics/signals';
import type { ToolOverlay } from '../../overlay/tool-overlay';
import type { Editor } from '../../session/editor';
import type { SignalEdges } from './signal-edges';

/** Radius of the rings at stop lines, metres; width of outlines, pixels. */
const RING_M = 1.1;
const OUTLINE_PX = 2;

export class MapItemOverlay implements ToolOverlay {
  constructor(
    private readonly editor: Editor,
    private readonly edges: SignalEdges,
  ) {}

  watch(): void {
    void [this.editor.mapItem.value, this.edges.lanes.value];
  }

  paint(g: Pen, v: View): void {
    const item = this.editor.mapItem.value;
    const scene = this.editor.scene.value;
    if (!item || !scene) return;
    const { map, signals } = scene;
    const c = colours();
    const lane = item.kind === 'lane' && map.lanes.get(item.lane);
    if (lane) polyline(g, v, lane.line.pts, c.select, Math.min(3.2, lane.width) * v.z, 0.22);
    const crosswalk = item.kind === 'crosswalk' && map.crosswalks[item.index];
    if (crosswalk) polyline(g, v, [...crosswalk, crosswalk[0]], c.select, OUTLINE_PX);
    if (item.kind === 'stop-sign') ring(g, v, item.at);
    for (const s of signals) {
      const at = this.edges.lanes.value.includes(s.lane) ? stopOf(s, map.lanes.get(s.lane)) : null;
      if (at) ring(g, v, at);
    }
  }
}

function ring(g: Pen, v: View, [x, y]: Vec): void {
  g.beginPath();
  g.arc(...v.to(x, y), Math.max(7, RING_M * v.z), 0, Math.PI * 2);
  g.strokeStyle = colours().select;
  g.lineWidth = OUTLINE_PX;
  g.setLineDash([]);
  g.stroke();
}
