// Putting road users into the scene: one a click, or many with one drag.
import type { Vec } from '../../model/base/geometry';
import { KIND_WORDS, countWords, type PlacedKind } from '../../model/base/kinds';
import type { Newcomer } from '../../model/document/newcomer';
import { startPose } from '../../model/document/scene';
import { metres } from '../../model/base/units';
import { alongLine, ghostsFor, overArea, snapNewcomer } from '../placing';
import { freeShift, inTheWay, standing } from '../room';
import type { Editor } from '../editor';
import { addThem, tooMany } from '../several';
import { shifted } from '../../model/document/newcomer';
import type { Chart, State } from './chart';
import type { Press } from './pressed';
import { TEXTS } from '../../texts/desk/gestures';

/** The ghost of somebody of a kind under the pointer. */
export const ghostHere = (chart: Chart, kind: PlacedKind, at = chart.at, heading?: number): void => {
  const { editor, surface } = chart;
  const scene = editor.scene.peek();
  if (!scene) return;
  const { view } = surface;
  const place = view.from(at.x, at.y);
  if (heading === undefined && isOnSelected(editor, place)) editor.placement.show(null);
  else editor.placement.pointAt(scene, kind, place, view.z, chart.modifiers.alt, heading);
  surface.invalidate('overlay');
};

/** On who was just put there no other is meant: a hand that rests there need not be told that it is taken. */
function isOnSelected(editor: Editor, [x, y]: Vec): boolean {
  const a = editor.agent.peek();
  const p = a?.placed ? startPose(a) : null;
  return !!a && !!p && Math.hypot(x - p.x, y - p.y) < a.length / 2;
}

/** Puts the ghost into the scene. Where somebody stands it asks first, and names the nearest free place. */
export function placeGhost(editor: Editor): void {
  const scene = editor.scene.peek();
  const ghost = editor.placement.ghosts.peek()?.all[0];
  if (!scene || !ghost) return;
  editor.playhead.pause();
  editor.setTime(0);
  const full = tooMany(scene, 1);
  if (full) {
    editor.notices.show({ text: full });
    return;
  }
  const put = (who: Newcomer): void => {
    const now = editor.scene.peek();
    if (now) editor.run(addThem(now, [who], 'placed'));
    // Until the pointer moves on, a ghost would only cover the new one.
    editor.placement.show(null);
  };
  if (ghost.fits) {
    put(ghost.who);
    return;
  }
  const there = inTheWay(ghost.who, standing(scene)) as ReturnType<typeof standing>[number] | undefined;
  const free = furtherOn(editor, ghost.who);
  const { x, y } = ghost.who.pose;
  const far = free && Math.hypot(free.pose.x - x, free.pose.y - y);
  const where = far ? TEXTS.orFurtherOn(metres(far, 1)) : '';
  editor.notices.show(
    {
      text: TEXTS.standsHerePut(there?.agent.name ?? TEXTS.somebody, where),
      ...(free ? { action: { label: TEXTS.furtherOn, run: () => put(free) } } : {}),
      second: { label: TEXTS.putHere, run: () => put(ghost.who) },
    },
    12_000,
  );
}

const FURTHER_M = 60;
const STEP_M = 0.4;

/** The nearest free place ahead on the lane, else anywhere near. */
function furtherOn(editor: Editor, n: Newcomer): Newcomer | null {
  const scene = editor.scene.peek()!;
  const taken = standing(scene);
  let at = n;
  for (let d = 0; d < FURTHER_M; d += STEP_M) {
    const { heading } = at.pose;
    const on = shifted(at, Math.cos(heading) * STEP_M, Math.sin(heading) * STEP_M);
    const s = snapNewcomer(scene, on, 1);
    at = s.lane ? { ...on, pose: { ...on.pose, x: s.x, y: s.y, heading: s.heading } } : on;
    if (!inTheWay(at, taken)) return at;
  }
  const shift = freeShift([n], taken);
  return shift && shifted(n, shift[0], shift[1]);
}

/** Held down, the ghost stays and turns towards the pointer. */
class TurningGhost implements State {
  readonly name = 'turning';
  readonly followsModifiers = true;
  readonly #from: Vec;

  constructor(
    private readonly chart: Chart,
    private readonly press: Press,
    private readonly kind: PlacedKind,
  ) {
    this.#from = chart.surface.view.from(press.x, press.y);
  }

  move(): void {
    const { chart, press } = this;
    const [x, y] = chart.surface.view.from(chart.at.x, chart.at.y);
    ghostHere(chart, this.kind, press, Math.atan2(y - this.#from[1], x - this.#from[0]));
  }

  up(): void {
    const { chart } = this;
    this.move();
    placeGhost(chart.editor);
    chart.rest();
    chart.editor.placement.show(null);
  }

  cancel(): boolean {
    this.chart.editor.placement.show(null);
    return true;
  }
}

/** Many along the line that is drawn, or over the rectangle. */
class Spreading implements State {
  readonly name = 'spreading';
  readonly followsView = true;
  readonly #from: Vec;

  constructor(
    private readonly chart: Chart,
    press: Press,
    private readonly kind: PlacedKind,
  ) {
    this.#from = chart.surface.view.from(press.x, press.y);
  }

  leave(): void {
    this.chart.editor.placement.show(null);
    this.chart.editor.sweepOver(null);
  }

  move(): void {
    const { chart, kind } = this;
    const { editor, surface } = chart;
    const scene = editor.scene.peek()!;
    const choice = editor.placement.choice(kind);
    const to = surface.view.from(chart.at.x, chart.at.y);
    const { view: v } = surface;
    const inLine = choice.spread === 'line';
    const area: readonly Vec[] = inLine ? [this.#from, to] : v.frame(this.#from, to);
    const all = inLine
      ? alongLine(scene, choice, this.#from, to, v.z)
      : overArea(scene, choice, v.frame(this.#from, to), v.z);
    const ghosts = ghostsFor(scene, all, '');
    const n = ghosts.all.filter((g) => g.fits).length;
    const words = n < choice.count ? TEXTS.ofFit(n, countWords(kind, choice.count)) : countWords(kind, n);
    editor.placement.show({ ...ghosts, words });
    editor.sweepOver({ outline: area, ids: [] });
    surface.invalidate('overlay');
  }

  up(): void {
    const { chart, kind } = this;
    const { editor } = chart;
    this.move();
    const scene = editor.scene.peek()!;
    const wanted = editor.placement.choice(kind).count;
    const all = editor.placement.ghosts.peek()!.all.flatMap((g) => (g.fits ? [g.who] : []));
    chart.rest();
    const full = tooMany(scene, all.length);
    if (full || !all.length) {
      editor.notices.show({ text: full ?? TEXTS.thereIsNoRoom });
      return;
    }
    const short = all.length < wanted ? TEXTS.ofPlacedNoRoom(all.length, countWords(kind, wanted)) : null;
    editor.run(addThem(scene, all, 'placed', short));
  }

  cancel(): boolean {
    return true;
  }
}

const place = <K extends PlacedKind>(kind: K, key: string) => ({
  name: `place-${kind}` as const,
  label: TEXTS.placeA(KIND_WORDS[kind]),
  key,
  icon: kind,
  help: `place-${kind}` as const,
  cursor: 'crosshair',
  picks: false,
  places: kind,
  hover: (chart: Chart): void => ghostHere(chart, kind),
  drag: (chart: Chart, press: Press): State => {
    const { spread } = chart.editor.placement.choice(kind);
    return spread === 'one' ? new TurningGhost(chart, press, kind) : new Spreading(chart, press, kind);
  },
  click: (chart: Chart, press: Press): void => {
    ghostHere(chart, kind, press);
    placeGhost(chart.editor);
  },
});

export const PLACE = [
  place('car', '1'),
  place('truck', '2'),
  place('bus', '3'),
  place('motorcycle', '4'),
  place('cyclist', '5'),
  place('pedestrian', '6'),
] as const;
