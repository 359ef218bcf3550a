// Nothing is pressed: what the pointer is over lights up.
import { NOTHING, type Hit } from '../hit';
import type { Chart, PointerDown, State } from './chart';
import { Pressed } from './pressed';
import type { Tool } from './tools';

export class Idle implements State {
  readonly name = 'idle';
  constructor(private readonly chart: Chart) {}

  move(): void {
    const { chart } = this;
    const select = chart.editor.tool.peek() === 'select';
    this.#hover(select ? chart.parts.hitAt(chart.at, false) : NOTHING);
  }

  outside(): void {
    this.#hover(NOTHING);
  }

  down(p: PointerDown): void {
    const { chart } = this;
    const tool = this.#toolFor(p);
    const hit = tool.picks && p.button !== 2 ? chart.parts.hitAt(p, p.touch) : NOTHING;
    const { cx, cy } = chart.surface.view;
    chart.go(new Pressed(chart, tool, { x: p.x, y: p.y, touch: p.touch, hit, cx, cy }));
  }

  /** The middle button and Space move the picture, whatever tool is chosen. */
  #toolFor(p: PointerDown): Tool {
    const { chart } = this;
    return chart.parts.tool(p.button === 1 || chart.spaceHeld ? 'pan' : chart.editor.tool.peek());
  }

  #hover(hit: Hit): void {
    const { chart } = this;
    chart.editor.pointAt({
      agent: hit.kind === 'agent' ? hit.id : null,
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
        return { body: 'grab', heading: 'crosshair', speed: 'resize', time: 'resize' }[hit.grip.handle];
      case 'agent':
        return editor.time.peek() < 0.05 ? 'grab' : 'pointer';
      case 'future':
      case 'by road':
        return 'pointer';
      case 'none':
        return parts.tool(editor.tool.peek()).cursor;
    }
  }
}
