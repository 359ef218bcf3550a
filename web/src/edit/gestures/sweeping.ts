// Taking many at once: a frame drawn over the ground, or a line drawn round them. Whose middle lies inside is taken.
import { insidePolygon, type Vec } from '../../model/base/geometry';
import type { View } from '../../draw/view';
import { kindsWords } from '../../model/base/kinds';
import { poseShown } from '../frame';
import type { Chart, State } from './chart';
import type { Press } from './pressed';
import { TEXTS } from '../../texts/desk/gestures';

/** Makes the outline longer, or anew, for the newest place. */
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

  /** Shift adds to those who were selected, Alt takes away from them. */
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
