// What of the speed curve cannot be driven, in words, and what can be done about it: pointed at it is shown, pressed it
// is one step.
import { useEffect } from 'preact/hooks';
import { misfitOf, type Misfit, type Way } from '../../model/curve-fit';
import { limitsOf, topSpeed } from '../../model/domain';
import { canMove } from '../../model/scene';
import { metres, num, speedLabel, type SpeedUnit } from '../../model/units';
import { useApp } from '../parts/app-context';
import { Icon } from '../parts/icons';

export function CurveMisfit() {
  const { editor } = useApp();
  const { curve } = editor;
  // What is shown goes with its buttons.
  useEffect(() => () => curve.try(null), [curve]);
  const a = editor.agent.value;
  const profile = curve.asked.value;
  const { duration = 0 } = editor.scene.value ?? {};
  if (!a || !profile || !canMove(a)) return null;
  const goal = a.goal.pos && { at: a.goal.pos, time: a.goal.time };
  const misfit = misfitOf({ profile, limits: limitsOf(a), duration, top: topSpeed(a), goal });
  if (!misfit) return null;
  const unit = editor.unitOf(a);
  return (
    <div class="misfit" role="group" aria-label="Why the curve cannot be driven">
      <p role="status">
        <Icon name="warn" size={15} />
        {wordsOf(misfit, unit)}
      </p>
      {misfit.ways.map((way) => {
        const label = labelOf(way, misfit, unit);
        const show = () => curve.try(way);
        const stop = () => curve.try(null);
        return (
          <button
            key={way.kind}
            type="button"
            class="btn line"
            data-way={way.kind}
            onPointerEnter={show}
            onPointerLeave={stop}
            onFocus={show}
            onBlur={stop}
            onClick={() => curve.accept(way)}
          >
            {label}
          </button>
        );
      })}
    </div>
  );
}

function wordsOf(m: Misfit, unit: SpeedUnit): string {
  if (m.what === 'short') return `Cannot make it by ${num(m.time, 1)} s: ${metres(m.by, 0)} short.`;
  const [wanted, reached] = [speedLabel(m.point.v, unit), speedLabel(m.reached, unit)];
  const by = `${num(m.point.t, 1)} s`;
  if (m.what === 'gathering') return `Cannot reach ${wanted} by ${by}: ${reached} is the most by then.`;
  return m.point.v > 0
    ? `Cannot brake to ${wanted} by ${by}: still ${reached} then.`
    : `Cannot stop by ${by}: still ${reached} then.`;
}

function labelOf(w: Way, { what }: Misfit, unit: SpeedUnit): string {
  if (w.kind === 'later') return `Give it ${num(w.by, 1)} s more`;
  if (w.kind === 'shorter') return `Shorter stop, ${num(w.hold, 1)} s`;
  const to = speedLabel(w.v, unit);
  if (what === 'short') return `Leave at ${to}`;
  return what === 'braking' ? `Only down to ${to}` : `Only up to ${to}`;
}
