// One field for several road users: the common value, or "mixed" with its range. Typed values go to all.
import { useRef } from 'preact/hooks';
import { useComputed, useSignal, type ReadonlySignal } from '@preact/signals';
import { clamp, deg, rad, wrapAngle } from '../../model/base/geometry';
import { rangesOf, topSpeed } from '../../model/base/domain';
import { startPose, type Agent } from '../../model/document/scene';
import {
  fromLength,
  fromUnit,
  lengthRange,
  lengthStep,
  lengthUnit,
  lengthUnitWord,
  num,
  type Quantity,
  readTyped,
  sizeText,
  speedText,
  toLength,
  toUnit,
  walkingUnit,
} from '../../model/base/units';
import type { Command } from '../../model/document/commands';
import type { Editor } from '../../edit/session/editor';
import { goalTime } from '../../edit/moves/moves';
import * as several from '../../edit/moves/several';
import { useApp } from '../parts/app-context';
import { useLiveEffect } from '../parts/hooks';
import { arrowStep, noNumber, outside, Scrub, WHY_MS } from '../parts/number-field';
import { TEXTS } from '../../texts/panels/several-panel';

/** A shared field. Values are in the displayed unit. */
export interface FieldOfSeveral {
  readonly word: string;
  readonly label: string;
  readonly field: string;
  readonly step: number;
  unit(all: readonly Agent[]): string;
  quantity(all: readonly Agent[]): Quantity;
  /** Null for a road user without the value. */
  of(a: Agent, all: readonly Agent[]): number | null;
  text(v: number, all: readonly Agent[]): string;
  range(all: readonly Agent[]): readonly [number, number];
  command(all: readonly Agent[], to: (now: number) => number, fold?: string): Command | null;
}

/** If all are pedestrians, their unit; otherwise the unit of vehicles. */
const speedUnit = (e: Editor, all: readonly Agent[]) =>
  all.every((a) => a.type === 'pedestrian') ? walkingUnit(e.view.speedUnit.value) : e.view.speedUnit.value;

const inAll = (all: readonly Agent[], of: (a: Agent) => readonly [number, number]): readonly [number, number] => [
  Math.max(...all.map((a) => of(a)[0])),
  Math.min(...all.map((a) => of(a)[1])),
];

function speedField(e: Editor, part: 'start' | 'goal'): FieldOfSeveral {
  const mps = (a: Agent): number | null => (part === 'start' ? (startPose(a)?.speed ?? null) : a.goal.speed);
  return {
    word: TEXTS.speed,
    label: part === 'start' ? TEXTS.speedOfAll : TEXTS.goalSpeedOfAll,
    field: `all-${part}-speed`,
    step: 1,
    unit: (all) => speedUnit(e, all),
    quantity: (all) => speedUnit(e, all),
    of: (a, all) => {
      const v = mps(a);
      return v === null ? null : toUnit(v, speedUnit(e, all));
    },
    text: (v, all) => speedText(fromUnit(v, speedUnit(e, all)), speedUnit(e, all)),
    range: (all) => [0, toUnit(Math.min(...all.map(topSpeed)), speedUnit(e, all))],
    command: (all, to, fold) => {
      const unit = speedUnit(e, all);
      const of = (a: Agent): number => toUnit(mps(a) ?? startPose(a)?.speed ?? 0, unit);
      const what = part === 'start' ? TEXTS.speed : TEXTS.goalSpeed;
      // Each within its own limits: a sum that fits one need not fit another.
      return several.setAll(all, part, 'speed', (a) => clamp(fromUnit(to(of(a)), unit), 0, topSpeed(a)), what, fold);
    },
  };
}

function sizeField(name: 'length' | 'width'): FieldOfSeveral {
  const word = name === 'length' ? TEXTS.length : TEXTS.width;
  return {
    word,
    get label() {
      return TEXTS.ofAllIn(word, lengthUnitWord());
    },
    field: `all-${name}`,
    get step() {
      return lengthStep(0.1);
    },
    unit: lengthUnit,
    quantity: () => 'length',
    of: (a) => toLength(a[name]),
    text: (v) => sizeText(fromLength(v)),
    range: (all) => lengthRange(inAll(all, (a) => rangesOf(a)[`${name}_m`])),
    command: (all, to, fold) =>
      several.setAll(
        all,
        'start',
        name,
        (a) => clamp(fromLength(to(toLength(a[name]))), ...rangesOf(a)[`${name}_m`]),
        word,
        fold,
      ),
  };
}

export const sharedFields = (e: Editor) =>
  ({
    heading: {
      word: TEXTS.heading,
      label: TEXTS.headingOfAll,
      field: 'all-start-heading',
      step: 1,
      unit: () => '°',
      quantity: () => 'angle',
      of: (a) => {
        const p = startPose(a);
        return p && Math.round(deg(p.heading));
      },
      text: (v) => num(v, 0),
      range: () => [-3600, 3600],
      command: (all, to, fold) =>
        several.setAll(
          all,
          'start',
          'heading',
          (a) => wrapAngle(rad(to(deg(startPose(a)?.heading ?? 0)))),
          TEXTS.heading,
          fold,
        ),
    },
    speed: speedField(e, 'start'),
    goalSpeed: speedField(e, 'goal'),
    time: {
      word: TEXTS.time,
      label: TEXTS.timeAtTheGoal,
      field: 'all-goal-time',
      step: 0.1,
      unit: () => 's',
      quantity: () => 'time',
      of: (a) => a.goal.time,
      text: (v) => num(v, 1),
      range: () => [1, e.scene.value?.length ?? 9],
      command: (all, to, fold) =>
        several.setAll(all, 'goal', 'time', (a) => goalTime(e.scene.peek(), to(a.goal.time)), TEXTS.goalTime, fold),
    },
    length: sizeField('length'),
    width: sizeField('width'),
  }) satisfies Record<string, FieldOfSeveral>;

export function SharedField({ shared, those }: { shared: FieldOfSeveral; those: ReadonlySignal<readonly Agent[]> }) {
  const { editor } = useApp();
  const input = useRef<HTMLInputElement>(null);
  const typed = useRef(false);
  const bad = useSignal<string | null>(null);
  const values = useComputed(() => those.value.flatMap((a) => shared.of(a, those.value) ?? []));
  const common = useComputed(() => {
    const all = those.value;
    const texts = new Set(values.value.map((v) => shared.text(v, all)));
    return texts.size === 1 && values.value.length === all.length ? [...texts][0] : null;
  });
  const text = useComputed(() => common.value ?? (values.value.length ? TEXTS.mixedWord : TEXTS.freeWithin));
  const unit = useComputed(() => shared.unit(those.value));
  /** From least to greatest, or the number that have one. */
  const span = useComputed(() => {
    const v = values.value;
    if (common.value !== null || !v.length) return unit.value;
    const low = shared.text(Math.min(...v), those.value),
      high = shared.text(Math.max(...v), those.value);
    return low === high ? TEXTS.countAt(v.length, low, unit.value) : TEXTS.to(low, high, unit.value);
  });

  const show = () => {
    typed.current = false;
    input.current!.value = text.peek();
  };
  useLiveEffect(() => {
    const now = text.value;
    const el = input.current!;
    if (typed.current || el.value === now) return;
    el.value = now;
    if (document.activeElement === el) el.select();
  });

  const run = (to: (now: number) => number, live = false) => {
    const command = shared.command(several.movable(those.peek()), to, live ? 'live' : undefined);
    if (command) editor.commits.run(command);
  };
  /** An absolute value must be possible for all; a relative change is clamped for each. */
  const commit = (): boolean => {
    if (!typed.current) return true;
    const entered = input.current!.value;
    const to = entered === text.peek() ? undefined : readTyped(entered, shared.quantity(those.peek()));
    if (to === null) bad.value = noNumber(entered);
    else if (to && to(0) === to(1))
      bad.value = outside(to(0), { range: () => shared.range(those.peek()), unit: () => unit.peek() });
    if (bad.peek() !== null) return false;
    show();
    if (to) run(to);
    show();
    return true;
  };
  const keyDown = (e: KeyboardEvent) => {
    if (e.key === 'Enter') {
      if (commit()) input.current!.select();
      e.preventDefault();
    } else if (e.key === 'Escape') {
      bad.value = null;
      show();
      input.current!.blur();
      e.stopPropagation();
    } else if (e.key === 'ArrowUp' || e.key === 'ArrowDown') {
      e.preventDefault();
      if (!commit()) return;
      const d = arrowStep(e, shared.step);
      run((now) => now + d, true);
    }
  };
  const scrubbed = useRef(0);
  return (
    <label
      class={useComputed(() =>
        ['field', common.value === null && 'mixed', bad.value !== null && 'bad'].filter(Boolean).join(' '),
      )}
    >
      <Scrub
        letter="⇔"
        value={() => scrubbed.current}
        step={shared.step}
        set={(v) => {
          const d = v - scrubbed.current;
          scrubbed.current = v;
          run((now) => now + d, true);
        }}
      />
      <input
        ref={input}
        type="text"
        inputmode="decimal"
        autocomplete="off"
        spellcheck={false}
        aria-label={shared.label}
        data-field={shared.field}
        aria-invalid={useComputed(() => (bad.value === null ? null : 'true')) as never}
        onFocus={() => input.current!.select()}
        onInput={() => {
          typed.current = true;
          bad.value = null;
        }}
        onBlur={() => {
          if (!input.current || commit()) return;
          show();
          setTimeout(() => (bad.value = null), WHY_MS);
        }}
        onKeyDown={keyDown}
      />
      <span class="u">{span}</span>
      {bad.value === null ? null : (
        <span class="why" role="alert">
          {bad}
        </span>
      )}
    </label>
  );
}
