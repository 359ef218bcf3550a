// Two fingers on the selected road user, or on its goal: turned about each other they turn it; drawn apart or moved
// they zoom and move the picture, as anywhere else.
import { wrapAngle, type Point } from '../../model/base/geometry';
import { setGoal, setStart, type Command } from '../../model/document/commands';
import { canMove, startPose, type Agent } from '../../model/document/scene';
import type { Part } from '../editor';
import type { Chart, State } from './chart';
import { Pinching, turnOf } from './pinching';
import { TEXTS } from '../../texts/desk/gestures';

/** The middle of the two fingers lies so near to what they turn, pixels. */
const NEAR_PX = 44;
/** What they do is known after so much turning, or so much drawing apart or moving. */
const TURNS_RAD = 0.14;
const DRAWS = 1.2;
const MOVES_PX = 28;

interface Turned {
  readonly agent: Agent;
  readonly part: Part;
  readonly heading: number;
}

/** What two fingers would turn; null where none of it lies between them. */
function between({ editor, surface }: Chart, p: Point, q: Point): Turned | null {
  const agent = editor.agent.peek();
  if (!agent || !canMove(agent)) return null;
  const [x, y] = [(p.x + q.x) / 2, (p.y + q.y) / 2];
  const start = editor.time.peek() < 0.05 ? startPose(agent) : null;
  for (const [part, pose] of [['start', start] as const, ['goal', agent.goal.pos && editor.goalPose(agent)] as const]) {
    if (!pose) continue;
    const [px, py] = surface.view.to(pose.x, pose.y);
    if (Math.hypot(px - x, py - y) <= NEAR_PX) return { agent, part, heading: pose.heading };
  }
  return null;
}

/** What two fingers do that have just come down. */
export function twoFingers(chart: Chart, p: Point, q: Point): State {
  const what = between(chart, p, q);
  return what ? new Turning(chart, what, p, q) : new Pinching(chart);
}

class Turning implements State {
  readonly name = 'turning by fingers';
  #command: Command | null = null;
  #turned = 0;
  #begun = false;
  readonly #apart: number;
  readonly #middle: Point;

  constructor(
    private readonly chart: Chart,
    private readonly what: Turned,
    p: Point,
    q: Point,
  ) {
    this.#apart = Math.max(1, Math.hypot(p.x - q.x, p.y - q.y));
    this.#middle = { x: (p.x + q.x) / 2, y: (p.y + q.y) / 2 };
  }

  moveFinger(from: Point, to: Point, other: Point): void {
    this.#turned += turnOf(from, to, other);
    if (this.#begun || Math.abs(this.#turned) >= TURNS_RAD) return this.#turn();
    const drawn = Math.hypot(to.x - other.x, to.y - other.y) / this.#apart;
    const moved = Math.hypot((to.x + other.x) / 2 - this.#middle.x, (to.y + other.y) / 2 - this.#middle.y);
    if (drawn > DRAWS || drawn < 1 / DRAWS || moved > MOVES_PX) this.chart.go(new Pinching(this.chart));
  }

  #turn(): void {
    const { chart, what } = this;
    const { agent: a, part } = what;
    const { editor, previews, surface } = chart;
    if (!this.#begun) editor.beginDrag({ part, handle: 'heading' });
    this.#begun = true;
    const heading = wrapAngle(what.heading + this.#turned);
    editor.setHeadingFollows(part, a, false);
    this.#command =
      part === 'goal'
        ? setGoal(a, { ...a.goal, heading }, TEXTS.goalHeading)
        : setStart(a, { ...a.start, heading }, TEXTS.heading);
    editor.previewDrag(this.#command);
    previews.preview(a.id);
    surface.invalidate('overlay');
  }

  up(): void {
    if (this.#begun) this.chart.endDrag(this.#command);
    else this.chart.rest();
  }

  cancel(): boolean {
    return this.#begun && this.chart.dropDrag();
  }
}
