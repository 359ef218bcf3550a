// No button is pressed: highlights the object under the pointer.
import { NOTHING, type Chart, type Hit, type PointerDown, type State, type Tool } from './chart';
import { ASK } from './menu';
import { Pressed } from './pressed';

const CURSORS = {
  body: 'grab',
  heading: 'crosshair',
  speed: 'resize',
  time: 'resize',
  via: 'grab',
  ring: 'resize',
} as const;

export class Idle implements State {
  readonly name = 'idle';
  constructor(private readonly chart: Chart) {}

  move(): void {
    const { chart } = this;
    const tool = chart.parts.tool(chart.editor.tool.peek());
    this.#hover(tool.name === 'select' ? chart.parts.hitAt(chart.at, false) : NOTHING);
    tool.hover?.(chart);
  }

  outside(): void {
    this.#hover(NOTHING);
    this.chart.placement.show(null);
  }

  down(p: PointerDown): void {
    const { chart } = this;
    const tool = this.#toolFor(p);
    const hit = tool.picks ? chart.parts.hitAt(p, p.touch) : NOTHING;
    chart.go(new Pressed(chart, tool, { x: p.x, y: p.y, touch: p.touch, hit, camera: chart.surface.view.camera }));
  }

  /** The middle button and Space always move the picture; the right one does too, or opens a menu. */
  #toolFor(p: PointerDown): Tool {
    const { chart } = this;
    if (p.button === 2) return ASK;
    return chart.parts.tool(p.button === 1 || chart.spaceHeld ? 'pan' : chart.editor.tool.peek());
  }

  #hover(hit: Hit): void {
    const { chart } = this;
    chart.editor.pointAt({
      agent: hit.kind === 'agent' || hit.kind === 'pennant' ? hit.id : null,
      future: hit.kind === 'future' ? hit.index : null,
      grip: hit.kind === 'grip' ? hit.grip : null,
    });
    chart.surface.setCursor(this.#cursor(hit));
    chart.surface.invalidate('overlay');
  }

  #cursor(hit: Hit): string {
    const { editor, parts } = this.chart;
    switch (hit.kind) {
      case 'grip':
        return editor.agent.peek()?.locked ? 'pointer' : CURSORS[hit.grip.handle];
      case 'handle':
        return hit.handle.cursor;
      case 'agent':
        return editor.playhead.time.peek() < 0.05 ? 'grab' : 'pointer';
      case 'future':
      case 'pinned':
      case 'by-road':
      case 'pennant':
        return 'pointer';
      case 'frame':
        return { move: 'grab', turn: 'crosshair', spread: 'resize' }[hit.handle];
      case 'none':
        return parts.tool(editor.tool.peek()).cursor;
    }
  }
}
