// Selects many at once: by a marquee, or a lasso. Road users with their centre inside are selected.
import { insidePolygon, type Vec } from '../../model/base/geometry';
import type { View } from '../../draw/view';
import { kindsWords } from '../../model/base/kinds';
import { poseShown } from '../overlay/frame';
import type { Chart, Press, State } from './chart';
import { TEXTS } from '../../texts/desk/gestures';

/** Extends or replaces the outline for the newest place. */
export type Outline = (from: Vec, to: Vec, before: readonly Vec[], v: View) => readonly Vec[];

export const rectangle: Outline = (from, to, _, v) => v.frame(from, to);

export class Sweeping implements State {
  readonly followsView = true;
  readonly followsModifiers = true;
  #outline: readonly Vec[] = [];
  readonly #from: Vec;
  readonly #before: readonly string[];

  constructor(
    readonly name: string,
    private readonly chart: Chart,
    press: Press,
    private readonly outline: Outline,
  ) {
    this.#from = chart.surface.view.from(press.x, press.y);
    this.#before = chart.editor.selected.peek();
  }

  enter(): void {
    this.chart.surface.setCursor('crosshair');
  }

  leave(): void {
    this.chart.surface.setCursor('');
    this.chart.editor.sweepOver(null);
  }

  move(): void {
    const { chart } = this;
    const v = chart.surface.view;
    this.#outline = this.outline(this.#from, v.from(chart.at.x, chart.at.y), this.#outline, v);
    chart.editor.sweepOver({ outline: this.#outline, ids: this.#taken() });
  }

  /** Shift adds to the former selection, Alt removes from it. */
  #taken(): readonly string[] {
    const inside = this.#inside();
    const { alt, shift } = this.chart.modifiers;
    if (alt) return this.#before.filter((id) => !inside.includes(id));
    return shift ? [...this.#before, ...inside.filter((id) => !this.#before.includes(id))] : inside;
  }

  #inside(): string[] {
    const { editor } = this.chart;
    return [...editor.scene.peek()!.agents.values()]
      .filter((a) => {
        const p = a.type === 'other' ? null : poseShown(editor, a);
        return p !== null && insidePolygon(p.x, p.y, this.#outline);
      })
      .map((a) => a.id);
  }

  up(): void {
    const { chart } = this;
    this.move();
    const ids = this.#taken();
    chart.rest();
    chart.editor.selectAll(ids);
    const kinds = chart.editor.chosenOnes.map((a) => a.kind);
    if (ids.length > 1) chart.editor.notices.say(TEXTS.selected(kindsWords(kinds)));
  }

  cancel(): boolean {
    return true;
  }
}
