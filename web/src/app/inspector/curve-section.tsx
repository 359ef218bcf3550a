// A speed that was drawn by hand, in words: its points, and where it stops on the way.
import { useComputed } from '@preact/signals';
import { project } from '../../model/geometry';
import { lineOf, stopsOf, type SpeedPoint } from '../../model/profile';
import { metres, seconds, speedLabel } from '../../model/units';
import { useApp } from '../parts/app-context';
import { TEXTS } from '../../texts/curve-section';
import type { LiveAgent } from './use-agent';

export function CurveSection({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const { curve } = editor;
  const drawn = useComputed(() => curve.profile.value !== null).value;
  if (!drawn) return null;
  const points = curve.points.value;
  const unit = editor.unitOf(agent.value);
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
          <small>{kindOf(p, i, points.length)}</small>
        </button>
      ))}
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
  const motion = editor.futures.value?.modes[editor.chosen.value]?.motion;
  const stops = motion ? stopsOf(motion) : [];
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
