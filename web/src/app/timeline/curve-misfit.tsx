// Infeasible parts of the speed curve, in words, with remedies: hover previews one, a press is one step.
import { useEffect } from 'preact/hooks';
import { misfitOf, type Misfit, type CurveRemedy } from '../../model/physics/curve-fit';
import { limitsOf, topSpeed } from '../../model/base/domain';
import { canMove } from '../../model/document/scene';
import { metres, num, speedLabel, type SpeedUnit } from '../../model/base/units';
import { useApp } from '../parts/app-context';
import { Icon } from '../parts/icons';
import { TEXTS } from '../../texts/panels/point-fields';

export function CurveMisfit() {
  const { editor, curve } = useApp();
  // The preview ends with its buttons.
  useEffect(() => () => curve.try(null), [curve]);
  const a = editor.agent.value;
  const profile = curve.asked.value;
  const { duration = 0 } = editor.scene.value ?? {};
  if (!a || !profile || !canMove(a)) return null;
  const goal = a.goal.pos && { at: a.goal.pos, time: a.goal.time };
  const misfit = misfitOf({ profile, limits: limitsOf(a), duration, top: topSpeed(a), goal });
  if (!misfit) return null;
  const unit = editor.view.unitOf(a);
  return (
    <div class="misfit" role="group" aria-label={TEXTS.whyTheCurveCannot}>
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
  if (m.what === 'short') return TEXTS.cannotReachTheGoal(num(m.time, 1), metres(m.by, 0));
  const [wanted, reached] = [speedLabel(m.point.v, unit), speedLabel(m.reached, unit)];
  const by = `${num(m.point.t, 1)} s`;
  if (m.what === 'gathering') return TEXTS.cannotReachBy(wanted, by, reached);
  return m.point.v > 0 ? TEXTS.cannotBrakeTo(wanted, by, reached) : TEXTS.cannotStopBy(by, reached);
}

function labelOf(w: CurveRemedy, { what }: Misfit, unit: SpeedUnit): string {
  if (w.kind === 'later') return TEXTS.allowSMore(num(w.by, 1));
  if (w.kind === 'shorter') return TEXTS.shorterStopS(num(w.hold, 1));
  const to = speedLabel(w.v, unit);
  if (what === 'short') return TEXTS.leaveAt(to);
  return what === 'braking' ? TEXTS.onlyDownTo(to) : TEXTS.onlyUpTo(to);
}
