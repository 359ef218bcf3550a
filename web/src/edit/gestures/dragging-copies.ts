// Alt drags copies away from where they were made; the originals stay.
import type { Agent } from '../../model/document/scene';
import type { Vec } from '../../model/base/geometry';
import { shifted, type Newcomer } from '../../model/document/newcomer';
import { ghostsFor, snapNewcomer } from '../placing';
import { addThem, copiesOf, tooMany, whoWords } from '../several';
import type { Chart, State } from './chart';
import type { Press } from './pressed';
import { TEXTS } from '../../texts/desk/gestures';

export class DraggingCopies implements State {
  readonly name = 'dragging copies';
  readonly followsView = true;
  readonly followsModifiers = true;
  readonly #grab: Vec;
  readonly #copies: readonly Newcomer[];
  #there: readonly Newcomer[] = [];

  constructor(
    private readonly chart: Chart,
    press: Press,
    private readonly originals: readonly Agent[],
  ) {
    this.#grab = chart.surface.view.from(press.x, press.y);
    this.#copies = copiesOf(originals);
  }

  enter(): void {
    this.chart.surface.setCursor('grabbing');
  }

  leave(): void {
    this.chart.surface.setCursor('');
    this.chart.editor.placement.show(null);
  }

  move(): void {
    const { chart } = this;
    const scene = chart.editor.scene.peek()!;
    const [x, y] = chart.surface.view.from(chart.at.x, chart.at.y);
    const moved = this.#copies.map((n) => shifted(n, x - this.#grab[0], y - this.#grab[1]));
    this.#there = moved.length === 1 ? [this.#snapped(moved[0])] : moved;
    const words = TEXTS.copyOf(whoWords(this.originals));
    chart.editor.placement.show(ghostsFor(scene, this.#there, words));
    chart.surface.invalidate('overlay');
  }

  /** One alone keeps to lanes; Shift lets go of them, for Alt is what made it a copy. */
  #snapped(n: Newcomer): Newcomer {
    const { chart } = this;
    if (chart.modifiers.shift) return n;
    const { x, y, heading } = snapNewcomer(chart.editor.scene.peek()!, n, chart.surface.view.z);
    return { ...n, pose: { ...n.pose, x, y, heading } };
  }

  up(): void {
    const { chart } = this;
    const { editor } = chart;
    this.move();
    chart.rest();
    const scene = editor.scene.peek()!;
    const full = tooMany(scene, this.#there.length);
    if (full) editor.notices.show({ text: full });
    else if (this.#there.length) editor.run(addThem(scene, this.#there, 'copied'));
  }

  cancel(): boolean {
    this.chart.surface.invalidate('overlay');
    return true;
  }
}
