// The picture of a variant in its card, at the playhead: all share one clock.
import { useEffect, useRef } from 'preact/hooks';
import type { Pictured } from '../../edit/tools/variants/cards';
import { motionOf } from '../../model/physics/playback';
import { counted } from '../../model/physics/events';
import { poseAt } from '../../model/base/motion';
import { startPose } from '../../model/document/scene';
import type { Miniatures } from '../../draw/miniature';
import type { MapPicture } from '../../draw/paint-map';
import type { Pen } from '../../draw/pen';
import { stamp } from '../../draw/sprites';
import { trail } from '../../draw/strokes';
import { colours, modeColour } from '../../draw/theme';
import type { View } from '../../draw/view';
import { useApp } from '../parts/app-context';
import { useLiveEffect } from '../parts/hooks';

/** Shared by the pictures of all cards. */
export interface Album {
  readonly painter: Miniatures;
  readonly map: MapPicture;
  readonly view: View;
}

/** Interval between repaints during playback, milliseconds. */
const PAUSE_MS = (navigator.hardwareConcurrency || 2) > 2 ? 33 : 100;

export function LivePicture({ card, album }: { card: Pictured; album: Album }) {
  const { editor, ui } = useApp();
  const canvas = useRef<HTMLCanvasElement>(null);
  const now = useRef({ card, album });
  now.current = { card, album };
  const state = useRef({ seen: true, frame: 0, at: 0 });
  const draw = (time: number) => {
    const s = state.current;
    s.frame = 0;
    if (!canvas.current || !s.seen) return;
    if (editor.playhead.playing.peek() && time - s.at < PAUSE_MS) return ask();
    s.at = time;
    const { card: c, album: a } = now.current;
    const g = canvas.current.getContext('2d', { alpha: false })!;
    a.painter.paint(g, a.view, a.map, (pen) => paintCard(pen, a.view, c, editor.playhead.time.peek()));
  };
  const ask = () => {
    state.current.frame ||= requestAnimationFrame(draw);
  };
  useEffect(() => {
    const watch = new IntersectionObserver((all) => {
      state.current.seen = all.at(-1)!.isIntersecting;
      ask();
    });
    watch.observe(canvas.current!);
    return () => {
      watch.disconnect();
      cancelAnimationFrame(state.current.frame);
    };
  }, []);
  useLiveEffect(() => {
    void [editor.playhead.time.value, ui.theme.value];
    ask();
  });
  useEffect(ask, [card, album]);
  const { view } = album;
  return <canvas ref={canvas} width={view.w * view.dpr} height={view.h * view.dpr} aria-hidden="true" />;
}

/** Small road users are enlarged, to be visible on a card. */
const mini = <T extends { length: number; width: number }>(a: T) => ({
  ...a,
  mini: true,
  length: Math.max(1.6, a.length * 1.15),
  width: Math.max(1.6, a.width * 1.15),
});

const EVENT_PX = 4.5;

function paintCard(g: Pen, v: View, { scene, set, state, events }: Pictured, time: number): void {
  if (!scene || !set) return;
  const subject = state.subject === null ? undefined : scene.agents.get(state.subject);
  const f = subject && set.futures.get(subject.id);
  if (subject && f) {
    const colour = modeColour(Math.min(f.modes.length - 1, subject.chosen ?? f.chosen));
    trail(g, v, motionOf(scene, set, subject), { colour, width: 2, halo: true });
  }
  for (const a of scene.agents.values()) {
    const p = (time < 0.05 ? startPose(a) : null) ?? poseAt(motionOf(scene, set, a), time);
    if (p) stamp(g, v, mini(a), p, a.id === subject?.id);
  }
  g.setTransform(v.dpr, 0, 0, v.dpr, 0, 0);
  const c = colours();
  for (const e of counted(events)) {
    g.beginPath();
    g.arc(...v.to(e.at[0], e.at[1]), EVENT_PX, 0, Math.PI * 2);
    g.fillStyle = e.kind === 'collision' || e.kind === 'rule' ? c.collision : c.near;
    g.fill();
    g.strokeStyle = c.halo;
    g.lineWidth = 1.5;
    g.stroke();
  }
}
