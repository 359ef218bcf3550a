// A pointer without a page: drives the state chart of gestures like the page.
import { View } from '../../src/draw/view';
import { Editor } from '../../src/edit/session/editor';
import { Chart, NOTHING, type Hit, type Modifiers, type Surface } from '../../src/edit/gestures/chart';
import { Idle } from '../../src/edit/gestures/idle';
import { twoFingers } from '../../src/edit/gestures/turning';
import { Placement } from '../../src/edit/moves/placement';
import { PLACING } from '../../src/edit/tools/placing/feature';
import { POINTING } from '../../src/edit/tools/pointing/feature';
import type { Point } from '../../src/model/base/geometry';
import { crossing } from '../helpers';

const PLAIN: Modifiers = { alt: false, shift: false, ctrl: false };

export class Pointer {
  readonly editor = new Editor();
  readonly placement = new Placement();
  readonly view = new View();
  /** The object under the pointer, wherever it is. */
  hit: Hit = NOTHING;
  cursor = '';
  /** Road users with requested live futures, and the number of cancellations. */
  readonly previewed: string[] = [];
  dropped = 0;
  /** Is the picture still at its edges? */
  calm = true;
  /** Number of double vibrations. */
  ticked = 0;
  /** The magnified place. */
  magnified: Point | null = null;
  /** Numbers of fingers tapped at once. */
  readonly taps: number[] = [];
  /** Requested menus. */
  /** Milliseconds. */
  now = 0;
  readonly menus: string[] = [];
  readonly chart: Chart;

  constructor() {
    this.editor.join(this.placement);
    this.editor.open(crossing());
    const surface: Surface = {
      view: this.view,
      invalidate: () => undefined,
      viewChanged: () => undefined,
      setCursor: (name) => {
        this.cursor = name;
      },
      magnify: (place) => {
        this.magnified = place;
      },
    };
    this.chart = new Chart({
      surface,
      editor: this.editor,
      placement: this.placement,
      idle: (chart) => new Idle(chart),
      twoFingers,
      previews: { preview: (id) => this.previewed.push(id), cancelPreviews: () => this.dropped++ },
      hitAt: () => this.hit,
      agentsAt: () => (this.hit.kind === 'agent' ? this.hit.pile : []),
      reducedMotion: () => this.calm,
      ticks: () => this.ticked++,
      menu: (_, on, future) => this.menus.push(future === null ? on : `${on} ${future}`),
      tapped: (fingers) => this.taps.push(fingers),
      tool: (name) => [...POINTING.rail, ...PLACING.rail].find((t) => t.name === name)!,
    });
  }

  get state(): string {
    return this.chart.state.name;
  }

  down(p: Point, { id = 1, button = 0, touch = false, timeStamp = 0 } = {}): void {
    this.chart.down({ ...p, id, button, touch, timeStamp });
  }

  /** Moves, and advances a frame. */
  move(p: Point, { id = 1, ...mods }: Partial<Modifiers> & { id?: number } = {}): void {
    this.chart.move(id, p, { ...PLAIN, ...mods }, true);
    this.frame();
  }

  /** Moves ahead of the frame. */
  ahead(p: Point, { id = 1, ...mods }: Partial<Modifiers> & { id?: number } = {}): void {
    this.chart.moveAhead(id, p, { ...PLAIN, ...mods }, this.now);
  }

  /** Advances a frame. */
  frame(seconds = 0.016): void {
    this.now += seconds * 1000;
    this.chart.frame(seconds, this.now);
  }

  up(p: Point, { id = 1, timeStamp = 0 } = {}): void {
    this.chart.up(id, p, timeStamp);
  }

  click(p: Point, timeStamp = 0): void {
    this.down(p);
    this.up(p, { timeStamp });
  }

  /** Screen position of a world point. */
  at(x: number, y: number): Point {
    const [px, py] = this.view.to(x, y);
    return { x: px, y: py };
  }
}
