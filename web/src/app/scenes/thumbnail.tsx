// A thumbnail of a scene, painted with the code of the main picture. Its data is fetched for one scene at a time, and
// only when it is visible in the list.
import { useEffect, useRef } from 'preact/hooks';
import type { Client } from '../../net/client';
import type { SceneListItem } from '../../net/types';
import { busyBox } from '../../model/physics/scene-centre';
import { readScene } from '../../model/document/scene-reader';
import { isRecorded, startPose, type Scene } from '../../model/document/scene';
import { MapPicture } from '../../draw/paint-map';
import { paintOn } from '../../draw/recording/replay';
import { stamp } from '../../draw/sprites';
import { paletteStamp } from '../../draw/theme';
import { View } from '../../draw/view';
import { useApp } from '../parts/app-context';
import { useLiveEffect } from '../parts/hooks';

/** The first picture waits a little: the scene itself comes first. */
const BEHIND_MS = 250;
/** After a change of theme the main picture is painted first. */
const RECOLOUR_MS = 30;
const KEPT = 60;
const PX_PER_PX = 2;

interface Painted {
  readonly scene: Scene;
  readonly map: MapPicture;
}

const kept = new Map<string, Promise<Painted>>();
let queue: Promise<unknown> = Promise.resolve();

function load(client: Client, item: SceneListItem): Promise<Painted> {
  const key = `${item.id}:${item.etag ?? ''}`;
  const known = kept.get(key);
  if (known) return known;
  const loading = queue.then(async () => {
    const scene = readScene(await client.preview(item.id));
    return { scene, map: new MapPicture(scene.map, isRecorded(scene.source)) };
  });
  queue = loading.catch(() => kept.delete(key));
  kept.set(key, loading);
  if (kept.size > KEPT) kept.delete(kept.keys().next().value as string);
  return loading;
}

interface ThumbnailProps {
  item: SceneListItem;
  width: number;
  height: number;
}

export function Thumbnail({ item, width, height }: ThumbnailProps) {
  const { client, ui } = useApp();
  const canvas = useRef<HTMLCanvasElement>(null);
  const draw = () =>
    void load(client, item)
      .then((p) => canvas.current && paint(canvas.current, p, width, height))
      .catch(() => undefined);

  useEffect(() => {
    const seen = new IntersectionObserver((entries) => {
      if (!entries.some((e) => e.isIntersecting)) return;
      seen.disconnect();
      setTimeout(draw, BEHIND_MS);
    });
    seen.observe(canvas.current!);
    return () => seen.disconnect();
  }, []);
  useLiveEffect(() => {
    void ui.theme.value;
    if (canvas.current!.dataset.done) setTimeout(draw, RECOLOUR_MS);
  });
  return <canvas ref={canvas} width={width * PX_PER_PX} height={height * PX_PER_PX} aria-hidden="true" />;
}

/** Small road users are enlarged, to be visible. */
const mini = <T extends { length: number; width: number }>(a: T) => ({
  ...a,
  mini: true,
  length: Math.max(1.6, a.length * 1.25),
  width: Math.max(1.6, a.width * 1.25),
});

function paint(canvas: HTMLCanvasElement, { scene, map }: Painted, width: number, height: number): void {
  const v = new View();
  v.w = width;
  v.h = height;
  v.dpr = PX_PER_PX;
  v.fit(busyBox(scene), 4, 0.3);
  paintOn(canvas.getContext('2d')!, (pen) => {
    map.paint(pen, v, false);
    for (const a of scene.agents.values()) {
      const p = startPose(a);
      if (p) stamp(pen, v, mini(a), p);
    }
  });
  canvas.dataset.done = String(paletteStamp());
}
