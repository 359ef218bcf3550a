// A speed that was drawn by hand, in words: its points, and where it stops on the way.
import { useComputed } from '@preact/signals';
import { project } from '../../model/base/geometry';
import { poseAt, type Motion } from '../../model/base/motion';
import { lineOf, stopsOf } from '../../model/physics/speed-profile';
import type { SpeedPoint } from '../../model/document/profile';
import { metres, seconds, speedLabel } from '../../model/base/units';
import type { Editor } from '../../edit/editor';
import { useApp } from '../parts/app-context';
import { ActionButton } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { TEXTS } from '../../texts/panels/curve-section';
import type { LiveAgent } from './use-agent';

/** So long a new stop lasts, seconds. */
const STOP_S = 2;
/** A speed that is missed by more is said, m/s. */
const MISSED_MPS = 0.5;

/** The motion that comes of the curve, as far as it is worked out. */
const drivenOf = (e: Editor): Motion | undefined => e.toldFutures.value?.modes[e.toldChosen.value]?.motion;

export function CurveSection({ agent }: { agent: LiveAgent }) {
  const { editor, ui } = useApp();
  const { curve } = editor;
  // Who opens the tall timeline is about to draw one.
  const shown = useComputed(
    () => curve.profile.value !== null || (ui.tall.value && curve.points.value.length > 1),
  ).value;
  if (!shown) return null;
  const points = curve.points.value;
  const unit = editor.unitOf(agent.value);
  const driven = drivenOf(editor);
  /** What is driven instead where a point cannot be. */
  const missed = (p: SpeedPoint): string | null => {
    const now = curve.profile.value && driven && poseAt(driven, p.t);
    return now && Math.abs(now.speed - p.v) > MISSED_MPS ? TEXTS.drives(speedLabel(now.speed, unit)) : null;
  };
  return (
    <section class="sect curve" aria-label={TEXTS.speedOverTime}>
      <h3>
        {TEXTS.speedOverTime}
        <small>{TEXTS.points(points.length)}</small>
      </h3>
      {points.map((p, i) => (
        <button key={i} type="button" aria-pressed={curve.point.value === i} onClick={() => curve.take(i)}>
          <i>{i + 1}</i>
          <span>
            {TEXTS.at(seconds(p.t))}
            {p.hold ? TEXTS.for(seconds(p.hold)) : ''}
          </span>
          <b>{speedLabel(p.v, unit)}</b>
          <small>{missed(p) ?? kindOf(p, i, points.length)}</small>
        </button>
      ))}
      <div class="row adds">
        <button type="button" class="btn line" onClick={() => curve.addHere(null)}>
          <Icon name="plus" size={14} />
          {TEXTS.point}
        </button>
        <button type="button" class="btn line" onClick={() => curve.addHere(STOP_S)}>
          <Icon name="plus" size={14} />
          {TEXTS.stop}
        </button>
        <ActionButton id="add-via" class="line" icon="plus" size={14}>
          {TEXTS.via}
        </ActionButton>
      </div>
      <Stops agent={agent} />
    </section>
  );
}

const KINDS = TEXTS.kinds;

const kindOf = (p: SpeedPoint, i: number, n: number): string =>
  i === 0 ? KINDS.start : i === n - 1 ? KINDS.end : p.v ? (p.hold ? KINDS.hold : '') : KINDS.stop;

function Stops({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const { profile } = editor.curve;
  const path = profile.value?.path;
  const motion = drivenOf(editor);
  const stops = motion ? stopsOf(motion, profile.value?.points) : [];
  if (!path || !stops.length) return null;
  const line = lineOf(path);
  return (
    <dl class="wh figures" aria-label={TEXTS.whereItStops}>
      {stops.flatMap(({ pose, from, lasts }) => [
        <dt key={from}>{TEXTS.stops(editor.curve.placeOf(agent.value, pose))}</dt>,
        <dd key={`${from}:`}>{TEXTS.after(metres(project(line, pose.x, pose.y).s, 1), seconds(lasts))}</dd>,
      ])}
    </dl>
  );
}
