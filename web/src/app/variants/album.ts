// The view shared by the pictures of several cards.
import { useRef } from 'preact/hooks';
import { boxOf, type Box, type Vec } from '../../model/base/geometry';
import { busyBox } from '../../model/physics/scene-centre';
import { motionOf } from '../../model/physics/playback';
import { isRecorded } from '../../model/document/scene';
import { Miniatures } from '../../draw/miniature';
import { MapPicture } from '../../draw/paint-map';
import { View } from '../../draw/view';
import { turnAtRest } from '../hud/view-tick';
import { useApp } from '../parts/app-context';
import type { Pictured } from '../../edit/tools/variants/cards';
import type { Album } from './live-picture';

const CARD_W = 174;
const CARD_H = 92;
const LOW_H = 60;
/** A lower page has lower pictures, pixels. */
const LOW_PAGE = 800;
const MARGIN_M = 10;

/** One view for all of them, turned like the picture: on the motion of the subject, else where most movement is. */
export function useAlbum(cards: readonly Pictured[]): Album {
  const { editor, ui } = useApp();
  const kept = useRef<{ key: string; album: Album; of: unknown } | null>(null);
  void ui.theme.value;
  const scene = editor.scene.peek()!;
  const box = boxFor(cards) ?? busyBox(scene);
  const h = innerHeight < LOW_PAGE ? LOW_H : CARD_H;
  const turn = turnAtRest.value;
  const key = JSON.stringify([box, h, turn]);
  if (kept.current?.key !== key || kept.current.of !== scene.map) {
    const view = new View();
    Object.assign(view, { w: CARD_W, h, turn, dpr: Math.min(2, Math.max(1, devicePixelRatio || 1)) });
    view.fit(box, 5, 0.3);
    const map = kept.current?.of === scene.map ? kept.current.album.map : mapPicture(scene);
    kept.current = { key, of: scene.map, album: { view, map, painter: new Miniatures() } };
  }
  return kept.current.album;
}

const mapPicture = ({ map, source }: { map: Parameters<typeof busyBox>[0]['map']; source: string }) =>
  new MapPicture(map, isRecorded(source));

function boxFor(cards: readonly Pictured[]): Box | null {
  const pts = cards.flatMap(({ scene, set, state, events }): Vec[] => {
    const a = state.subject === null ? undefined : scene?.agents.get(state.subject);
    if (!a || !scene || !set) return [];
    const m = motionOf(scene, set, a);
    const way = Array.from(m.x, (x, i): Vec => [x, m.y[i]]);
    return [...way, ...events.filter((e) => !e.inLog).map((e) => e.at)];
  });
  if (!pts.length) return null;
  const b = boxOf(pts);
  return { x0: b.x0 - MARGIN_M, y0: b.y0 - MARGIN_M, x1: b.x1 + MARGIN_M, y1: b.y1 + MARGIN_M };
}
