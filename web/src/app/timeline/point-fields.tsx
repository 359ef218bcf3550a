// The point of the speed curve that is in use, in numbers: how fast, for how long, when.
import { acceleration, fromUnit, inTenths, num, speedText, toUnit } from '../../model/base/units';
import { hardestBraking } from '../../model/base/motion';
import { roomOf } from '../../model/physics/speed-profile';
import { topSpeed } from '../../model/base/domain';
import { useApp } from '../parts/app-context';
import { CurveMisfit } from './curve-misfit';
import { Icon } from '../parts/icons';
import { NumberField } from '../parts/number-field';
import { TEXTS } from '../../texts/panels/point-fields';

/** Braking is marked from here on, m/s². */
const HARD_MPS2 = 4;
const TOO_HARD_MPS2 = 8;

export function PointFields() {
  const { editor } = useApp();
  const { curve } = editor;
  const agent = editor.agent.value;
  const i = curve.point.value;
  const p = i === null ? undefined : curve.points.value[i];
  if (!agent || agent.locked || i === null || !p || !curve.profile.value) return null;
  const unit = editor.unitOf(agent);
  // Which point it is, too, is read anew: the fields stay while another is taken.
  const at = () => curve.point.value ?? i;
  const room = () => roomOf(curve.points.value, at(), editor.scene.value?.duration ?? 9);
  const now = () => curve.points.value[at()] ?? p;
  // Of what is in hand, too.
  const shown = editor.futures.value?.modes[editor.chosen.value]?.motion ?? editor.motionFor(agent);
  const braking = hardestBraking(shown);
  return (
    <div
      class="card pointfields"
      role="group"
      aria-label={TEXTS.pointOfTheSpeed}
      onPointerDown={(e) => e.stopPropagation()}
    >
      <CurveMisfit />
      <div class="row">
        <NumberField
          label={TEXTS.speedAtThisPoint}
          field="point-speed"
          unit={() => unit}
          quantity={() => unit}
          step={inTenths(unit) ? 0.1 : 1}
          range={() => [0, toUnit(topSpeed(agent), unit)]}
          value={() => toUnit(now().v, unit)}
          text={() => speedText(now().v, unit)}
          set={(v) => curve.set(i, { v: fromUnit(v, unit) })}
        />
        <span>{TEXTS.for}</span>
        <NumberField
          label={TEXTS.secondsThatIt}
          field="point-hold"
          unit={() => 's'}
          quantity={() => 'time'}
          step={0.1}
          range={() => room().hold}
          value={() => now().hold}
          text={() => num(now().hold, 1)}
          set={(hold) => curve.set(i, { hold })}
        />
        {i ? (
          <>
            <span>{TEXTS.at}</span>
            <NumberField
              label={TEXTS.timeOfThisPoint}
              field="point-time"
              unit={() => 's'}
              quantity={() => 'time'}
              step={0.1}
              range={() => room().t}
              value={() => now().t}
              text={() => num(now().t, 1)}
              set={(t) => curve.set(i, { t })}
            />
          </>
        ) : null}
        {i && i < curve.points.value.length - 1 ? (
          <button type="button" class="btn i" aria-label={TEXTS.removeThisPoint} onClick={() => curve.remove(i)}>
            <Icon name="x" size={16} />
          </button>
        ) : null}
        <button type="button" class="btn" onClick={() => curve.clear()}>
          {TEXTS.clearTheCurve}
        </button>
        <span class={`brakes ${braking > TOO_HARD_MPS2 ? 'toohard' : braking > HARD_MPS2 ? 'hard' : ''}`}>
          {TEXTS.brakesAtMost(acceleration(braking))}
        </span>
      </div>
    </div>
  );
}
