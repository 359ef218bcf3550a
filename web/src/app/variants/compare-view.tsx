// Two variants beside each other: the left one is the picture itself, the right one another that follows its view.
import { useEffect, useRef } from 'preact/hooks';
import type { Compared, WholeCard } from '../../edit/tools/variants/cards';
import { motionOf } from '../../model/physics/playback';
import { poseAt } from '../../model/base/motion';
import { isRecorded, startPose, type Agent } from '../../model/document/scene';
import type { Pose } from '../../model/base/geometry';
import type { Context } from '../../actions/context';
import { paintBeside } from '../../edit/overlay/beside';
import { paintEventsAt } from '../../edit/overlay/events';
import { Labels } from '../../draw/labels';
import { MapPicture } from '../../draw/paint-map';
import type { Pen } from '../../draw/pen';
import { paintSignals } from '../../draw/signals';
import { stamp } from '../../draw/sprites';
import { Stage } from '../../draw/stage';
import { trail } from '../../draw/strokes';
import { modeColour } from '../../draw/theme';
import type { View } from '../../draw/view';
import { useApp } from '../parts/app-context';
import { useLiveEffect } from '../parts/hooks';
import { verdictOf } from './card';
import { TEXTS } from '../../texts/panels/variants-panel';

export default function CompareView() {
  const c = useApp();
  const now = c.variants.comparing.compared.value;
  useEffect(() => {
    c.stage.element.classList.add('halved');
    c.ui.showDrawer(null);
    return () => c.stage.element.classList.remove('halved');
  }, []);
  if (!now) return null;
  return (
    <>
      <SideTitle card={now.left} side="left" />
      <Pane now={now} />
      <SideTitle card={now.right} side="right" />
    </>
  );
}

const letterOf = ({ scene, set, state }: WholeCard): number | null => {
  const a = state.subject === null ? undefined : scene.agents.get(state.subject);
  const f = a && set.futures.get(a.id);
  return a && f ? Math.min(f.modes.length - 1, a.chosen ?? f.chosen) : null;
};

function SideTitle({ card, side }: { card: WholeCard; side: 'left' | 'right' }) {
  const verdict = verdictOf(card);
  return (
    <div class={`card sidetitle ${side}`}>
      <b>
        {card.id} {card.name}
      </b>
      <span class={`tag ${verdict.colour}`}>{verdict.word}</span>
    </div>
  );
}

/** Zoom for each pixel of wheel. */
const WHEEL_ZOOM = 0.0016;

function Pane({ now }: { now: Compared }) {
  const c = useApp();
  const el = useRef<HTMLElement>(null);
  const stage = useRef<Stage | null>(null);
  const shown = useRef(now);
  shown.current = now;
  useEffect(() => {
    const own = new Stage(el.current!);
    stage.current = own;
    paintersOf(own, c, shown);
    const follow = () => {
      own.view.look(c.stage.view.camera);
      own.viewChanged();
    };
    follow();
    const end = c.stage.moved.listen(follow);
    return () => {
      end();
      own.close();
    };
  }, []);
  useEffect(() => stage.current?.invalidate('map', 'agents', 'overlay'), [now]);
  useLiveEffect(() => {
    void c.editor.playhead.time.value;
    stage.current?.invalidate('agents', 'overlay');
  });
  useLiveEffect(() => {
    void c.ui.theme.value;
    stage.current?.themeChanged();
  });
  return (
    <section
      ref={el}
      class="pane"
      aria-label={TEXTS.variantNamed(now.right.id, now.right.name)}
      onPointerDown={(e) => e.currentTarget.setPointerCapture(e.pointerId)}
      onPointerMove={(e) => {
        if (!e.buttons) return;
        c.stage.glide.stop();
        c.stage.view.panBy(e.movementX, e.movementY);
        c.stage.viewChanged();
      }}
      onWheel={(e) => {
        e.preventDefault();
        const box = e.currentTarget.getBoundingClientRect();
        c.stage.glide.stop();
        c.stage.view.zoomAt(e.clientX - box.left, e.clientY - box.top, Math.exp(-e.deltaY * WHEEL_ZOOM));
        c.stage.viewChanged();
      }}
    />
  );
}

function paintersOf(stage: Stage, { editor }: Context, shown: { readonly current: Compared }): void {
  const { scene } = shown.current.right;
  const map = new MapPicture(scene.map, isRecorded(scene.source));
  const labels = new Labels();
  const poseIn =
    ({ scene: of, set }: WholeCard, time: number) =>
    (who: Agent): Pose | null => {
      const a = of.agents.get(who.id) ?? who;
      return (time < 0.05 ? startPose(a) : null) ?? poseAt(motionOf(of, set, a), time);
    };
  stage.painter('map', (g, v) => map.paint(g, v, editor.view.layers.peek().lanes));
  stage.painter('agents', (g, v) => {
    if (editor.view.layers.peek().signals) paintSignals(g, v, shown.current.right.scene, editor.playhead.time.peek());
    paintAgents(g, v, shown.current.right, editor.playhead.time.peek(), poseIn);
  });
  stage.painter('overlay', (g, v) => {
    const { left, right, comparison } = shown.current;
    const time = editor.playhead.time.peek();
    labels.reset(v, { left: 0, right: 0, top: 44, bottom: 0 });
    paintBeside(
      g,
      v,
      { scene: left.scene, set: left.set, diverging: comparison.diverging.map((p) => p.agent.id) },
      time,
    );
    paintSubject(g, v, right);
    paintEventsAt(g, v, labels, right.events, time, poseIn(right, time));
  });
}

type PoseIn = (card: WholeCard, time: number) => (a: Agent) => Pose | null;

function paintAgents(g: Pen, v: View, card: WholeCard, time: number, poseIn: PoseIn): void {
  const at = poseIn(card, time);
  const all = [...card.scene.agents.values()].flatMap((a) => {
    const p = at(a);
    return p ? [{ a, p }] : [];
  });
  // Large before small, so that no pedestrian is hidden under a bus.
  all.sort((p, q) => q.a.length * q.a.width - p.a.length * p.a.width);
  for (const { a, p } of all) stamp(g, v, a, p);
  g.setTransform(v.dpr, 0, 0, v.dpr, 0, 0);
}

function paintSubject(g: Pen, v: View, card: WholeCard): void {
  const i = letterOf(card);
  const a = card.state.subject === null ? undefined : card.scene.agents.get(card.state.subject);
  if (i === null || !a) return;
  const style = { colour: modeColour(i), width: 3.5, halo: true, dots: true };
  trail(g, v, motionOf(card.scene, card.set, a), style);
}
