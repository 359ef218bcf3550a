// Pressed and not yet moved: the release is a click, a movement becomes the gesture of the tool.
import { ask } from './menu';
import type { Chart, Press, State, Tool } from './chart';

/** A movement shorter than this is a click. A finger is less steady than a mouse. */
const START_PX = 3;
const START_PX_TOUCH = 8;
/** A finger that rests this long opens a menu, seconds. */
const ASKS_AFTER_S = 0.5;

export class Pressed implements State {
  readonly name = 'pressed';
  #held = 0;
  constructor(
    private readonly chart: Chart,
    private readonly tool: Tool,
    private readonly press: Press,
  ) {}

  enter(): void {
    // Time advances with frames, and a resting finger requests none.
    if (this.press.touch) this.chart.surface.invalidate();
  }

  frame(seconds: number): boolean {
    if (!this.press.touch) return false;
    this.#held += seconds;
    if (this.#held >= ASKS_AFTER_S) {
      this.chart.go(new MenuOpened(this.chart));
      ask(this.chart, this.press);
    }
    // A resting finger sends no moves, and without a frame time does not advance.
    else this.chart.surface.invalidate();
    return false;
  }

  move(): void {
    const { chart, press } = this;
    const far = Math.hypot(chart.at.x - press.x, chart.at.y - press.y);
    if (far < (press.touch ? START_PX_TOUCH : START_PX)) return;
    chart.go(this.tool.drag(chart, press));
    chart.state.move?.();
  }

  up(timeStamp: number): void {
    this.chart.rest();
    this.tool.click(this.chart, this.press, timeStamp);
  }
}

/** A menu is open; the finger that opened it is still down. */
class MenuOpened implements State {
  readonly name = 'asked';
  constructor(private readonly chart: Chart) {}

  up(): void {
    this.chart.rest();
  }
}
