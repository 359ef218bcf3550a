// The picture on screen as lines and areas, for drawing programs and print.
import { colourKey, sizeOnScreen } from '../../draw/sprites';
import { colours, modeColour } from '../../draw/theme';
import type { View } from '../../draw/view';
import { motionOf } from '../../model/changes';
import type { MotionSet } from '../../model/futures';
import type { Vec } from '../../model/geometry';
import { poseAt } from '../../model/motion';
import { isRecorded, startPose, type Scene } from '../../model/scene';

/** Metres of road painted around a lane of a map that knows no surface. */
const BAND_M = 5.2;

const escaped = (s: string): string =>
  s.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;').replaceAll('"', '&quot;');

export function svgOf(scene: Scene, motion: MotionSet, time: number, v: View): string {
  const c = colours();
  const n = (x: number): string => (Math.round(x * 10) / 10).toString();
  const points = (pts: readonly Vec[]): string => pts.map(([x, y]) => `${n(v.x(x))},${n(v.y(y))}`).join(' ');
  const path = (pts: readonly Vec[]): string => `M${points(pts).replaceAll(' ', 'L')}`;
  const out: string[] = [];
  const group = (attributes: string, inside: string[]): void => {
    if (inside.length) out.push(`<g ${attributes}>${inside.join('')}</g>`);
  };
  const lines = (all: readonly (readonly Vec[])[]): string[] => all.map((p) => `<polyline points="${points(p)}"/>`);
  const areas = (all: readonly (readonly Vec[])[]): string[] => all.map((p) => `<polygon points="${points(p)}"/>`);
  const { map } = scene;
  const roads = [...map.lanes.values()].filter((l) => l.kind !== 'walk');
  const wide = map.drivable.length ? null : BAND_M;
  const bands = (extra: number): string[] =>
    roads.map(
      (l) => `<polyline points="${points(l.line.pts)}" stroke-width="${n(((wide ?? l.width) + extra) * v.z)}"/>`,
    );
  const surface = map.drivable.map((d) => `<path d="${[d.outer, ...d.holes].map((p) => `${path(p)}Z`).join('')}"/>`);
  const round = 'fill="none" stroke-linejoin="round" stroke-linecap="round"';
  group(`${round} stroke="${c['map-kerb']}"`, bands(2 / v.z));
  group(`fill="${c['map-asphalt']}" fill-rule="evenodd"`, surface);
  group(`${round} stroke="${c['map-asphalt']}"`, bands(0));
  group(`fill="${c['map-lot']}"`, areas(map.driveways));
  group(`fill="${c['map-crosswalk']}" opacity="0.6"`, areas(map.crosswalks));
  group(`${round} stroke="${c['map-kerb']}" stroke-width="1.4"`, lines(map.edges.map((e) => e.line.pts)));
  group(`fill="none" stroke="${c['map-line']}" stroke-width="1.2"`, lines(map.lines.map((l) => l.line.pts)));
  group(
    `${round} stroke-width="2.5"`,
    futuresOf(scene, motion).map(([pts, k]) => `<polyline points="${points(pts)}" stroke="${modeColour(k)}"/>`),
  );
  for (const a of scene.agents.values()) {
    const p = time < 0.05 ? (startPose(a) ?? poseAt(a.log, 0)) : poseAt(motionOf(scene, motion, a), time);
    if (!p) continue;
    const [l, w] = sizeOnScreen(a, v.z);
    const turn = (-p.heading * 180) / Math.PI;
    out.push(
      `<g transform="translate(${n(v.x(p.x))} ${n(v.y(p.y))}) rotate(${n(turn)})"><title>${escaped(a.name)}</title>` +
        `<rect x="${n(-l / 2)}" y="${n(-w / 2)}" width="${n(l)}" height="${n(w)}" rx="${n(Math.min(w * 0.3, 5))}" ` +
        `fill="${c[colourKey(a)]}" stroke="${c.halo}"/></g>`,
    );
  }
  const ground = isRecorded(scene.source) ? c['map-paved'] : c['map-ground'];
  const title = `<title>${escaped(scene.name)}, ${time.toFixed(1)} s</title>`;
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" width="${v.w}" height="${v.h}" viewBox="0 0 ${v.w} ${v.h}">${title}` +
    `<desc>${n(v.z)} px a metre; x east, y north</desc>` +
    `<rect width="100%" height="100%" fill="${ground}"/>${out.join('')}</svg>\n`
  );
}

/** The futures that are followed by those who have a goal, with the place of each among its six. */
function futuresOf(scene: Scene, motion: MotionSet): [Vec[], number][] {
  const out: [Vec[], number][] = [];
  for (const a of scene.agents.values()) {
    const f = a.goal.pos ? motion.futures.get(a.id) : undefined;
    const k = f ? Math.min(f.modes.length - 1, a.chosen ?? f.chosen) : -1;
    const m = f?.modes[k]?.motion;
    if (m) out.push([Array.from(m.x, (x, i): Vec => [x, m.y[i]]), k]);
  }
  return out;
}
