// Paints a map being made in place of the scene, once the painter is loaded.
import type { Labels } from '../../../draw/labels';
import type { Pen } from '../../../draw/pen';
import type { View } from '../../../draw/view';
import type { ToolOverlay } from '../../overlay/tool-overlay';
import type { ArmsOverlay } from './arms-overlay';
import type { LateTools } from './late-tools';
import type { Layouts } from './layouts';

export class LayoutOverlay implements ToolOverlay {
  #arms: ArmsOverlay | null = null;

  constructor(
    private readonly layouts: Layouts,
    private readonly late: LateTools,
  ) {}

  get isAlone(): boolean {
    return this.layouts.isOpen.value;
  }

  watch(): void {
    const { arm, drawn, fault, made, turned, under, way } = this.layouts;
    void [arm, drawn, fault, made, turned, under, way, this.late.tools].map((s) => s.value);
  }

  paint(g: Pen, v: View, labels: Labels): void {
    const tools = this.layouts.isOpen.value && this.late.tools.value;
    if (tools) (this.#arms ??= new tools.ArmsOverlay(this.layouts, labels)).paint(g, v);
  }
}
