// Rows of the panel of a map being made: a number, a count, a choice.
import type { ComponentChildren } from 'preact';
import { rangeOf } from '../../model/document/layouts';
import { fromUnit, lengthUnit, num, speedText, toLength, toUnit } from '../../model/base/units';
import { useApp } from '../parts/app-context';
import { NumberField } from '../parts/number-field';
import { Slider } from '../parts/slider';
import { TEXTS } from '../../texts/panels/layouts';

/** The rows of the panel, in order; `whole` ones are counts. */
interface ParameterLine {
  readonly label: string;
  readonly unit: string;
  readonly step: number;
}
export const LINES: Readonly<Record<string, ParameterLine>> = {
  length_m: { label: TEXTS.length, unit: 'm', step: 10 },
  bend_deg: { label: TEXTS.bend, unit: '°', step: 5 },
  radius_m: { label: TEXTS.radius, unit: 'm', step: 5 },
  lanes: { label: TEXTS.lanes, unit: '', step: 1 },
  lanes_forward: { label: TEXTS.lanesForward, unit: '', step: 1 },
  lanes_backward: { label: TEXTS.lanesBack, unit: '', step: 1 },
  island_radius_m: { label: TEXTS.island, unit: 'm', step: 1 },
  ring_lanes: { label: TEXTS.ringLanes, unit: '', step: 1 },
  ring_lane_width_m: { label: TEXTS.ringLaneWidth, unit: 'm', step: 0.25 },
  ring_speed_limit_kmh: { label: TEXTS.ringSpeedLimit, unit: 'km/h', step: 5 },
  parallel_m: { label: TEXTS.parallelLength, unit: 'm', step: 10 },
  ramp_angle_deg: { label: TEXTS.rampAngle, unit: '°', step: 1 },
  ramp_speed_limit_kmh: { label: TEXTS.rampSpeedLimit, unit: 'km/h', step: 10 },
  aisles: { label: TEXTS.aisles, unit: '', step: 1 },
  bays: { label: TEXTS.baysPerSide, unit: '', step: 1 },
  bay_width_m: { label: TEXTS.bayWidth, unit: 'm', step: 0.1 },
  bay_length_m: { label: TEXTS.bayLength, unit: 'm', step: 0.1 },
  aisle_m: { label: TEXTS.aisleWidth, unit: 'm', step: 0.25 },
  speed_limit_kmh: { label: TEXTS.speedLimit, unit: 'km/h', step: 10 },
  cycle_lane_m: { label: TEXTS.cycleLane, unit: 'm', step: 0.1 },
  parking_m: { label: TEXTS.parking, unit: 'm', step: 0.1 },
  median_m: { label: TEXTS.median, unit: 'm', step: 0.5 },
  crosswalk_m: { label: TEXTS.crosswalk, unit: 'm', step: 0.5 },
  kerb_radius_m: { label: TEXTS.kerbRadius, unit: 'm', step: 0.5 },
  lane_width_m: { label: TEXTS.laneWidth, unit: 'm', step: 0.25 },
  sidewalk_m: { label: TEXTS.pavement, unit: 'm', step: 0.5 },
};
/** Values found by trial: draggable, and typed. */
const DRAGGED: ReadonlySet<string> = new Set(['kerb_radius_m', 'lane_width_m']);
export function Row({ label, children }: { label: string; children: ComponentChildren }) {
  return (
    <div class="line">
      <span>{label}</span>
      {children}
    </div>
  );
}

export interface NumberRowProps {
  place: string;
  name: string;
  value: () => number;
  set: (v: number) => void;
}

export function NumberRow({ place, name, value, set }: NumberRowProps) {
  const { editor, layouts } = useApp();
  const { speedUnit } = editor.view;
  const { label, unit, step } = LINES[name];
  const template = layouts.wish.value!.template;
  const whole = Number.isInteger(step) && !unit;
  const digits = whole ? 0 : step < 1 ? 2 : 0;
  if (unit === 'km/h')
    return (
      <Row label={label}>
        <NumberField
          label={label}
          field={`layout-${place}`}
          unit={() => speedUnit.value}
          quantity={() => speedUnit.value}
          step={speedUnit.value === 'km/h' ? step : 5}
          value={() => toUnit(value() / 3.6, speedUnit.value)}
          text={() => speedText(value() / 3.6, speedUnit.value)}
          set={(v) => set(Number((fromUnit(v, speedUnit.peek()) * 3.6).toFixed(6)))}
          range={() => {
            const [min, max] = rangeOf(template, place);
            return [toUnit(min / 3.6, speedUnit.value), toUnit(max / 3.6, speedUnit.value)];
          }}
        />
      </Row>
    );
  const told = unit === 'm' ? toLength : (v: number) => v;
  const text = () => num(told(value()), Number.isInteger(told(value())) ? 0 : lengthUnit() === 'm' ? digits || 1 : 1);
  const range = rangeOf(template, place);
  return (
    <Row label={label}>
      {DRAGGED.has(name) ? (
        <Slider label={label} value={value()} range={range} step={step} text={`${text()} ${lengthUnit()}`} set={set} />
      ) : null}
      <NumberField
        label={label}
        field={`layout-${place}`}
        unit={() => (unit === 'm' ? lengthUnit() : unit)}
        quantity={() => (unit === 'm' ? 'length' : unit ? 'angle' : 'count')}
        step={step}
        value={value}
        text={text}
        set={(v) => set(whole ? Math.round(v) : v)}
        range={() => range}
      />
    </Row>
  );
}

export function Count({ label, value, set }: { label: string; value: number; set: (v: number) => void }) {
  return (
    <span class="count" role="group" aria-label={label}>
      <button type="button" aria-label={TEXTS.oneFewer(label)} disabled={value <= 0} onClick={() => set(value - 1)}>
        −
      </button>
      <b>{value}</b>
      <button type="button" aria-label={TEXTS.oneMore(label)} disabled={value >= 5} onClick={() => set(value + 1)}>
        +
      </button>
    </span>
  );
}

export function Choice<T extends string>({
  label,
  items,
  value,
  set,
}: {
  label: string;
  items: readonly (readonly [T, string])[];
  value: T | undefined;
  set: (v: T) => void;
}) {
  return (
    <Row label={label}>
      <div class="seg" role="group" aria-label={label}>
        {items.map(([id, text]) => (
          <button
            key={id}
            type="button"
            class={`btn ${id === value ? 'on' : ''}`}
            aria-pressed={id === value}
            onClick={() => set(id)}
          >
            {text}
          </button>
        ))}
      </div>
    </Row>
  );
}
