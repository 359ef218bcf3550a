// New variants by a swept number: which one, its range, and its step.
import { limitsOfSweep, LEAST_STEP, type Over } from '../../model/physics/sweep';
import { fromUnit, inTenths, num, type Quantity, toUnit } from '../../model/base/units';
import { perform } from '../../actions/registry';
import { useApp } from '../parts/app-context';
import { NumberField } from '../parts/number-field';
import { TEXTS } from '../../texts/panels/variants-panel';

const BY: readonly (readonly [Over, string])[] = [
  ['start', TEXTS.bySpeedAtThe],
  ['goal', TEXTS.bySpeedAtTheGoal],
  ['time', TEXTS.byTimeAtTheGoal],
];

const SAID: Record<Over, string> = { start: TEXTS.startsAt, goal: TEXTS.arrivesAt, time: TEXTS.reachesTheGoalAfter };

/** Difference of new ones: the seed, or a number of the subject. */
export function RangePick() {
  const { variants } = useApp();
  const sweep = variants.range.sweep.value;
  if (!variants.subject.value && !sweep) return null;
  return (
    <select
      class="field pick"
      aria-label={TEXTS.whatNewVariants}
      value={sweep?.over ?? ''}
      onChange={(e) => variants.range.over((e.currentTarget.value || null) as Over | null)}
    >
      <option value="">{TEXTS.bySeed}</option>
      {BY.map(([over, words]) => (
        <option key={over} value={over}>
          {words}
        </option>
      ))}
    </select>
  );
}

/** The range as a sentence with input fields. */
export function Range() {
  const c = useApp();
  const { editor, variants } = c;
  const sweep = variants.range.sweep.value;
  const subject = variants.subject.value;
  if (!sweep) return null;
  const obstacle = variants.range.obstacle.value;
  const unit = sweep.over === 'time' || !subject ? 's' : editor.view.unitOf(subject);
  const quantity: Quantity = unit === 's' ? 'time' : unit;
  const decimals = unit === 's' || inTenths(unit) ? 1 : 0;
  const shown = (v: number) => (unit === 's' ? v : toUnit(v, unit));
  const meant = (v: number) => (unit === 's' ? v : fromUnit(v, unit));
  const limits = (): readonly [number, number] => {
    const scene = editor.scene.peek();
    if (!scene || !subject) return [0, 0];
    const [least, most] = limitsOfSweep(subject, scene, sweep.over);
    return [shown(least), shown(most)];
  };
  const field = (which: 'from' | 'to' | 'step', label: string) => {
    const value = () => shown((variants.range.sweep.value ?? sweep)[which]);
    return (
      <NumberField
        key={`${which} ${unit}`}
        label={label}
        field={`range-${which}`}
        unit={() => (which === 'from' ? '' : unit)}
        quantity={() => quantity}
        step={decimals ? 0.5 : 5}
        value={value}
        text={() => num(value(), decimals)}
        range={which === 'step' ? () => [shown(LEAST_STEP), limits()[1]] : limits}
        set={(v) => variants.range.set({ [which]: meant(v) })}
      />
    );
  };
  const n = variants.wanted.value;
  return (
    <div class="range" role="group" aria-label={TEXTS.rangeOfTheNew}>
      {subject ? (
        <>
          <span>
            <b>{subject.name}</b> {SAID[sweep.over]}
          </span>
          {field('from', TEXTS.firstValue)}
          <span>{TEXTS.to}</span>
          {field('to', TEXTS.lastValue)}
          <span>{TEXTS.inStepsOf}</span>
          {field('step', TEXTS.step)}
        </>
      ) : null}
      {obstacle ? (
        <span class="why" role="status">
          {obstacle}
        </span>
      ) : (
        <button
          type="button"
          class="btn pri"
          disabled={variants.making.value !== null}
          onClick={() => perform(c, 'make-variants')}
        >
          {TEXTS.makeVariants(n)}
        </button>
      )}
    </div>
  );
}
