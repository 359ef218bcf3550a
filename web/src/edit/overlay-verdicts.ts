// What is wrong with the futures of the selected road user, on the lines themselves: stretches, ground, and a word
// at each place.
import type { Fault } from '../model/about';
import { faultPlaces, type FaultPlace } from '../model/fault-places';
import type { Futures } from '../model/futures';
import { nameIn, type Agent } from '../model/scene';
import { placeWord } from '../model/verdict-words';
import { paintBroken, paintGround, type Stretch } from '../draw/broken';
import { paintFlag, paintGhost } from '../draw/handles';
import { pill, tag, type Labels, type PillStyle, type Rect } from '../draw/labels';
import { modeStyle } from '../draw/strokes';
import { colours } from '../draw/theme';
import type { View } from '../draw/view';
import type { Editor } from './editor';
import { roadGoal } from './goal-verdict';

type G = CanvasRenderingContext2D;

/** More places than these are counted, not named. */
const NAMED = 3;

export class VerdictOverlay {
  constructor(
    private readonly editor: Editor,
    private readonly labels: Labels,
  ) {}

  /** Under the paths: the ground that the shown one crosses and should not. */
  paintGround(g: G, v: View, a: Agent, f: Futures, visible: readonly number[]): void {
    const crossed = (fault: Fault): boolean => fault.kind === 'over_median' || fault.kind === 'off_road';
    const shown = visible.length === 1 ? visible : visible.filter((i) => i === this.editor.chosen.value);
    paintGround(g, v, stretchesOf(f, shown, crossed), a.width);
  }

  /** On the paths: the stretches themselves. */
  paintStretches(g: G, v: View, f: Futures, visible: readonly number[]): void {
    const c = colours();
    const chosen = this.editor.chosen.value;
    const most = Math.max(...f.modes.map((m) => m.probability));
    for (const i of [...visible.filter((k) => k !== chosen), ...visible.filter((k) => k === chosen)]) {
      const m = f.modes[i];
      const { width, alpha } = modeStyle(m.probability, most);
      // The worst is painted last, on top.
      for (const fault of [...(m.about?.faults ?? [])].reverse()) {
        if (fault.kind === 'goal_missed') continue;
        paintBroken(g, v, stretchOf(f, i, fault), {
          width: i === chosen ? Math.max(width, 3.2) : width,
          alpha: i === chosen ? 1 : Math.max(0.45, 0.85 * alpha),
          colour: fault.kind === 'near_miss' ? c['near-edge'] : c.collision,
        });
      }
    }
  }

  /** One word at each place; a red path never goes without. */
  paintWords(g: G, v: View, f: Futures, visible: readonly number[]): void {
    const inView = (p: FaultPlace): boolean => !this.labels.outside(v.x(p.fault.at[0]), v.y(p.fault.at[1]));
    const places = faultPlaces(f, visible, this.editor.chosen.value).filter(inView);
    if (places.length) this.labels.avoiding(pathBoxes(v, f, visible), () => this.placeWords(g, v, places));
  }

  private placeWords(g: G, v: View, places: readonly FaultPlace[]): void {
    const nameOf = nameIn(this.editor.scene.peek()!);
    places.slice(0, NAMED).forEach((p) => {
      const [x, y] = v.to(p.fault.at[0], p.fault.at[1]);
      pill(g, this.labels, x, y, placeWord(p.fault, nameOf), pillStyle(p));
    });
    const rest = places.length - NAMED;
    if (rest > 0) {
      const [x, y] = v.to(places[NAMED].fault.at[0], places[NAMED].fault.at[1]);
      const { bg: leader } = pillStyle(places[NAMED]);
      pill(g, this.labels, x, y, `and ${rest} more`, { leader, border: leader, radii: RADII });
    }
  }

  /** Hollow: where the road leads to, when the goal is reached against the rules. */
  paintByRoad(g: G, v: View, a: Agent): void {
    const { editor: e } = this;
    const about = e.futures.value?.modes[e.chosen.value]?.about;
    const to = about?.faults.some((x) => x.kind !== 'goal_missed') ? roadGoal(e, a) : null;
    if (!to) return;
    const c = colours();
    const [x, y] = v.to(to.x, to.y);
    paintGhost(g, v, a, to, c.goal, c['goal-soft'], [4, 3]);
    paintFlag(g, this.labels, x, y, c.goal, true);
    const tries = [
      [34, -26],
      [-190, -26],
      [34, 8],
      [-190, 8],
    ] as const;
    tag(g, this.labels, [x, y], to.words, { tries, bg: c.goal, fg: c.surface });
  }
}

const RADII = [40, 56, 76, 100, 128];

function pillStyle({ mark }: FaultPlace): PillStyle {
  const c = colours();
  switch (mark) {
    case 'near':
      return { bg: c.near, fg: c['on-near'], icon: 'triangle', leader: c['near-edge'], height: 22, radii: RADII };
    case 'short':
      return { fg: c['ink-2'], icon: 'flag', leader: c['ink-3'], height: 22, radii: RADII };
    default: {
      const icon = mark === 'collision' ? 'cross' : 'bar';
      return { bg: c.collision, fg: c['on-collision'], icon, leader: c.collision, height: 22, radii: RADII };
    }
  }
}

const stretchOf = (f: Futures, i: number, fault: Fault): Stretch => ({
  motion: f.modes[i].motion,
  from: fault.time,
  to: fault.until,
});

const stretchesOf = (f: Futures, visible: readonly number[], want: (fault: Fault) => boolean): Stretch[] =>
  visible.flatMap((i) => (f.modes[i].about?.faults ?? []).filter(want).map((fault) => stretchOf(f, i, fault)));

/** Small boxes along the paths, which words keep clear of. */
function pathBoxes(v: View, f: Futures, visible: readonly number[]): Rect[] {
  const out: Rect[] = [];
  for (const i of visible) {
    const { x, y } = f.modes[i].motion;
    for (let k = 0; k < x.length; k += 3) out.push({ x: v.x(x[k]) - 4, y: v.y(y[k]) - 4, w: 8, h: 8 });
  }
  return out;
}
