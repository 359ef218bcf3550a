// Small pictures of scenes, painted with the same code as the big one. Scenes are fetched one after the other and
// only when their place in the list can be seen.
import type { Context } from '../actions/context';
import type { SceneListItem } from '../net/types';
import { boxOf, type Box, type Vec } from '../model/geometry';
import { isMapRef } from '../model/json';
import { readScene } from '../model/read';
import { isRecorded, startPose, type Scene } from '../model/scene';
import { MapPicture } from '../draw/paint-map';
import { stamp } from '../draw/sprites';
import { paletteStamp } from '../draw/theme';
import { View } from '../draw/view';
import { h, watch } from './dom';

interface Kept {
  scene: Scene;
  map: MapPicture;
}
const kept = new Map<string, Promise<Kept>>();
let queue: Promise<unknown> = Promise.resolve();

function load(c: Context, item: SceneListItem): Promise<Kept> {
  const key = `${item.id}:${item.etag ?? ''}`;
  let p = kept.get(key);
  if (!p) {
    p = queue.then(async () => {
      const { json } = await c.client.scene(item.id);
      const scene = readScene(json, isMapRef(json.map) ? await c.client.map(json.map.ref) : undefined);
      return { scene, map: new MapPicture(scene.map, isRecorded(scene.source)) };
    });
    queue = p.catch(() => kept.delete(key));
    kept.set(key, p);
    if (kept.size > 60) kept.delete(kept.keys().next().value as string);
  }
  return p;
}

export function thumbnail(c: Context, item: SceneListItem, w: number, ht: number): HTMLCanvasElement {
  const canvas = h('canvas', { width: w * 2, height: ht * 2, 'aria-hidden': 'true' });
  const draw = () =>
    void load(c, item)
      .then((k) => paint(canvas, k, w, ht))
      .catch(() => undefined);
  const seen = new IntersectionObserver((entries) => {
    if (!entries.some((e) => e.isIntersecting)) return;
    seen.disconnect();
    // Behind the first picture: the scene itself comes first.
    setTimeout(draw, 250);
  });
  seen.observe(canvas);
  let first = true;
  watch(() => {
    void c.ui.theme.value;
    if (!first && canvas.dataset.done) setTimeout(draw, 30);
    first = false;
  });
  return canvas;
}

function paint(canvas: HTMLCanvasElement, k: Kept, w: number, ht: number): void {
  const v = new View();
  v.w = w;
  v.h = ht;
  v.dpr = 2;
  v.fit(busyBox(k.scene), 4, 0.3);
  const g = canvas.getContext('2d')!;
  k.map.paint(g, v, false);
  for (const a of k.scene.agents.values()) {
    const p = startPose(a);
    if (p)
      stamp(
        g,
        v,
        { ...a, mini: true, length: Math.max(1.6, a.length * 1.25), width: Math.max(1.6, a.width * 1.25) },
        p,
      );
  }
  g.setTransform(1, 0, 0, 1, 0, 0);
  canvas.dataset.done = String(paletteStamp());
}

/** The middle of what moves: the median, so that one queue far out does not pull it away. */
export function busyCentre(scene: Scene): [number, number] {
  const at = [...scene.agents.values()]
    .filter((a) => !a.parked && a.type !== 'other')
    .map(startPose)
    .filter((p) => p !== null);
  if (!at.length) return [(scene.map.box.x0 + scene.map.box.x1) / 2, (scene.map.box.y0 + scene.map.box.y1) / 2];
  const median = (v: number[]): number => v.sort((a, b) => a - b)[v.length >> 1];
  return [median(at.map((p) => p.x)), median(at.map((p) => p.y))];
}

const JUNCTION_M = 30;

/** The middle of the junction the busy part is about; without one near it, the busy middle itself. */
export function sceneCentre(scene: Scene): [number, number] {
  const [bx, by] = busyCentre(scene);
  const inside = [...scene.map.lanes.values()]
    .filter((l) => l.inside && l.kind === 'road')
    .map((l) => l.line.pts[l.line.pts.length >> 1])
    .filter(([x, y]) => Math.hypot(x - bx, y - by) < 2 * JUNCTION_M);
  let best: readonly Vec[] = [],
    score = 0;
  for (const [x, y] of inside) {
    const round = inside.filter((p) => Math.hypot(p[0] - x, p[1] - y) < JUNCTION_M);
    const s = round.length - Math.hypot(x - bx, y - by) / 20;
    if (s > score) {
      score = s;
      best = round;
    }
  }
  if (best.length < 4) return [bx, by];
  const mean = (i: 0 | 1): number => best.reduce((sum, p) => sum + p[i], 0) / best.length;
  return [mean(0), mean(1)];
}

/** Where the road users are: the middle four fifths of them, so that one far away does not shrink the rest. */
export function busyBox(scene: Scene, margin = 8): Box {
  const moving = [...scene.agents.values()].filter((a) => !a.parked && a.type !== 'other');
  const at = moving.map(startPose).filter((p) => p !== null);
  if (at.length < 3) return scene.map.box;
  const cut = (v: number[]): [number, number] => {
    v.sort((a, b) => a - b);
    const n = Math.floor(v.length * 0.1);
    return [v[n], v[v.length - 1 - n]];
  };
  const [x0, x1] = cut(at.map((p) => p.x)),
    [y0, y1] = cut(at.map((p) => p.y));
  const b = boxOf([
    [x0, y0],
    [x1, y1],
  ] as Vec[]);
  return { x0: b.x0 - margin, y0: b.y0 - margin, x1: b.x1 + margin, y1: b.y1 + margin };
}
