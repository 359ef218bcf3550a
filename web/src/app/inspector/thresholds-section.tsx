// Thresholds of events in this scene, editable, with the usual ones beside them.
import { useComputed } from '@preact/signals';
import {
  isUsual,
  OFFERED,
  resetThresholds,
  setThreshold,
  threshold,
  usual,
  type ThresholdName,
} from '../../model/document/thresholds';
import { THRESHOLDS } from '../../model/base/domain';
import { accelerationUnit, lengthText, lengthUnit, num, seconds, type Quantity } from '../../model/base/units';
import { useApp } from '../parts/app-context';
import { NumberField } from '../parts/number-field';
import { TEXTS } from '../../texts/panels/thresholds-section';

const QUANTITY: Readonly<Record<ThresholdName, Quantity>> = {
  gap_m: 'length',
  ttc_s: 'time',
  harsh_brake_mps2: 'acceleration',
  harsh_lateral_mps2: 'acceleration',
};

const LABELS: Readonly<Record<ThresholdName, string>> = {
  gap_m: TEXTS.gap,
  ttc_s: TEXTS.time,
  harsh_brake_mps2: TEXTS.braking,
  harsh_lateral_mps2: TEXTS.steering,
};

const unitOf = (name: ThresholdName): string =>
  name === 'gap_m' ? lengthUnit() : name === 'ttc_s' ? 's' : accelerationUnit();

/** A value with its unit. */
export const told = (name: ThresholdName, v: number): string =>
  name === 'ttc_s' ? seconds(v) : `${lengthText(v, 1)} ${unitOf(name)}`;

export function ThresholdsSection({ last }: { last: boolean }) {
  const { editor } = useApp();
  const changed = useComputed(() => editor.resting.value !== null && !isUsual(editor.resting.value)).value;
  return (
    <section class={`sect counts ${last ? 'last' : ''}`} aria-label={TEXTS.thresholds}>
      <h3>
        {TEXTS.thresholds}
        <small>{changed ? TEXTS.changedHere : TEXTS.isDefault}</small>
      </h3>
      {OFFERED.map((name) => (
        <Line key={name} name={name} />
      ))}
      <p class="note">{TEXTS.whatANearMissIs}</p>
      {changed ? (
        <button type="button" class="btn line" onClick={() => editor.commits.run(resetThresholds())}>
          {TEXTS.resetToDefault}
        </button>
      ) : null}
    </section>
  );
}

function Line({ name }: { name: ThresholdName }) {
  const { editor } = useApp();
  const value = useComputed(() => (editor.resting.value ? threshold(editor.resting.value, name) : usual(name)));
  const own = useComputed(() => value.value !== usual(name)).value;
  const [min, max] = THRESHOLDS[name].range;
  return (
    <div class="pr count">
      <span class="lab">{LABELS[name]}</span>
      <NumberField
        label={LABELS[name]}
        field={`threshold-${name.replaceAll('_', '-')}`}
        unit={() => unitOf(name)}
        quantity={() => QUANTITY[name]}
        step={0.1}
        range={() => [min, max]}
        value={() => value.value}
        text={() => (name === 'ttc_s' ? num : lengthText)(value.value, 1)}
        set={(v) => {
          const s = editor.scene.peek();
          if (s) editor.commits.run(setThreshold(s, name, v));
        }}
      />
      <small class={own ? 'own' : ''}>{TEXTS.defaultIs(told(name, usual(name)))}</small>
    </div>
  );
}
