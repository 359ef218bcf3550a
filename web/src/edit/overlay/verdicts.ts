// Faults of the selected road user's futures on the lines themselves: stretches, ground, and a word at each place.
import type { Pen } from '../../draw/pen';
import type { Fault } from '../../model/document/future-facts';
import { faultPlaces, type FaultPlace } from '../../model/physics/fault-places';
import { LETTERS, type Futures } from '../../model/document/futures';
import type { Vec } from '../../model/base/geometry';
import { nameIn, type Agent } from '../../model/document/scene';
import { placeWord } from '../../model/words/verdict-words';
import { paintBroken, paintGround, type MotionStretch } from '../../draw/broken';
import { blockFlag, paintFlag, paintGhost } from '../../draw/handles';
import { pill, type Labels, type PillStyle, type Rect } from '../../draw/labels';
import { modeStyle, polyline } from '../../draw/strokes';
import { colours } from '../../draw/theme';
import type { View } from '../../draw/view';
import type { Editor } from '../session/editor';
import { roadWay } from '../moves/ways-out';

/** At most this many places of a path are named: the worst. */
const NAMED = 2;

export class VerdictOverlay {
  /** Painted place of the road route's sign, for the pointer. */
  roadSign: RoadSign | null = null;

  constructor(
    private readonly editor: Editor,
    private readonly labels: Labels,
  ) {}

  /** Under the paths: ground that the shown one crosses against the rules. */
  paintGround(g: Pen, v: View, a: Agent, f: Futures, visible: readonly number[], until = Infinity): void {
    const crossed = ({ kind, time }: Fault): boolean =>
      (kind === 'over_median' || kind === 'off_road') && time <= until;
    const shown = visible.length === 1 ? visible : visible.filter((i) => i === this.editor.reading.chosen.value);
    paintGround(g, v, stretchesOf(f, shown, crossed), a.width);
  }

  /** On the paths: the stretches themselves. */
  paintStretches(g: Pen, v: View, f: Futures, visible: readonly number[], until = Infinity): void {
    const c = colours();
    const chosen = this.editor.reading.chosen.value;
    const most = Math.max(...f.modes.map((m) => m.probability));
    for (const i of [...visible.filter((k) => k !== chosen), ...visible.filter((k) => k === chosen)]) {
      const m = f.modes[i];
      const { width, alpha } = modeStyle(m.probability, most);
      // The worst is painted last, on top.
      for (const fault of [...(m.about?.faults ?? [])].reverse()) {
        if (fault.kind === 'goal_missed' || fault.kind === 'via_missed' || fault.time > until) continue;
        const stretch = stretchOf(f, i, fault);
        paintBroken(
          g,
          v,
          { ...stretch, to: Math.min(stretch.to, until) },
          {
            width: i === chosen ? Math.max(width, 3.2) : width,
            alpha: i === chosen ? 1 : Math.max(0.45, 0.85 * alpha),
            colour: fault.kind === 'near_miss' ? c['near-edge'] : c.collision,
          },
        );
      }
    }
  }

  /** A word at the worst places of the shown path, or of the pointed one; the others' words are in the list. */
  paintWords(g: Pen, v: View, f: Futures, visible: readonly number[], most = NAMED): void {
    const inView = (p: FaultPlace): boolean => !this.labels.outside(...v.to(p.fault.at[0], p.fault.at[1]));
    const chosen = this.editor.reading.chosen.value;
    const path = visible.length === 1 ? visible[0] : chosen;
    const places = faultPlaces(f, visible, chosen).filter((p) => p.futures.includes(path) && inView(p));
    if (places.length) this.labels.avoiding(pathBoxes(v, f, visible), () => this.placeWords(g, v, places, most));
  }

  private placeWords(g: Pen, v: View, places: readonly FaultPlace[], most: number): void {
    const nameOf = nameIn(this.editor.scene.peek()!);
    places.slice(0, most).forEach((p) => {
      const [x, y] = v.to(p.fault.at[0], p.fault.at[1]);
      const words = placeWord(p.fault, nameOf);
      // Words on other futures name their letters; the panel covers the shown one.
      const of = p.futures.includes(this.editor.reading.chosen.value) ? '' : `${lettersOf(p.futures)} · `;
      pill(g, this.labels, x, y, `${of}${words}`, pillStyle(p));
    });
  }

  /** Under the paths: the route by the road, for a goal reached by breaking rules. */
  paintRoadBand(g: Pen, v: View, a: Agent): void {
    const way = roadWay(this.editor, a);
    if (!way) return;
    polyline(g, v, way.path, colours().goal, Math.max(6, a.width * 1.5 * v.z), 0.2, [], 'round');
    // Labels placed before the flag is painted leave space for it.
    if (way.to) blockFlag(this.labels, v.to(way.to.x, way.to.y), v.grip);
  }

  /** The goal of that route, hollow: a click takes it. `quiet`: without its words, which the panel has. */
  paintRoadWay(g: Pen, v: View, a: Agent, quiet: boolean): void {
    const way = roadWay(this.editor, a);
    if (!way) return;
    const c = colours();
    const { to, path } = way;
    if (to) {
      paintGhost(g, v, a, to, c.goal, c['goal-soft'], [4, 3]);
      paintFlag(g, this.labels, v.to(to.x, to.y), c.goal, true, v.grip);
    }
    if (quiet) return;
    const [wx, wy] = to ? [to.x, to.y] : path[path.length >> 1];
    const tries = [
      [34, -26],
      [-190, -26],
      [34, 8],
      [-190, 8],
    ] as const;
    const [x, y] = v.to(wx, wy);
    const label = pill(g, this.labels, x, y, way.words, { tries, bg: c.goal, fg: c.surface });
    this.roadSign = { label, flag: to && [x, y] };
  }
}

/** The sign of the road route on the picture: its label, and the foot of its flag. */
export interface RoadSign {
  readonly label: Rect | null;
  readonly flag: Vec | null;
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

const lettersOf = (futures: readonly number[]): string => futures.map((i) => LETTERS[i]).join(', ');

const stretchOf = (f: Futures, i: number, fault: Fault): MotionStretch => ({
  motion: f.modes[i].motion,
  from: fault.time,
  to: fault.until,
});

const stretchesOf = (f: Futures, visible: readonly number[], want: (fault: Fault) => boolean): MotionStretch[] =>
  visible.flatMap((i) => (f.modes[i].about?.faults ?? []).filter(want).map((fault) => stretchOf(f, i, fault)));

/** Small boxes along the paths, which labels avoid. */
function pathBoxes(v: View, f: Futures, visible: readonly number[]): Rect[] {
  const out: Rect[] = [];
  for (const i of visible) {
    const { x, y } = f.modes[i].motion;
    for (let k = 0; k < x.length; k += 3) out.push({ x: v.x(x[k], y[k]) - 4, y: v.y(x[k], y[k]) - 4, w: 8, h: 8 });
  }
  return out;
}
