// The driven road user: ring, speed, and the way it has come.
import type { Labels } from '../../../draw/labels';
import { tag } from '../../../draw/labels';
import { paintRing } from '../../../draw/handles';
import type { Pen } from '../../../draw/pen';
import { polyline } from '../../../draw/strokes';
import { colours } from '../../../draw/theme';
import type { View } from '../../../draw/view';
import { speedLabel } from '../../../model/base/units';
import type { ToolOverlay } from '../../overlay/tool-overlay';
import type { Editor } from '../../session/editor';
import type { Driving } from './driving';

export class DrivingOverlay implements ToolOverlay {
  constructor(
    private readonly editor: Editor,
    private readonly driving: Driving,
  ) {}

  watch(): void {
    void this.driving.frames.value;
  }

  get isAlone(): boolean {
    return this.driving.isOn.value;
  }

  paint(g: Pen, v: View, labels: Labels): void {
    const drive = this.driving.open.value;
    if (!drive) return;
    const { agent, now } = drive;
    polyline(g, v, [...drive.way, [now.x, now.y]], colours().select, 2, 0.7, [], 'round');
    paintRing(g, v, agent, now, colours().select, 2);
    tag(g, labels, v.to(now.x, now.y), speedLabel(now.speed, this.editor.view.unitOf(agent)), { radii: [30, 42, 56] });
  }
}
