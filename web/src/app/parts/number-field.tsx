// A field for one number: shows what the handle shows, takes sums and units, steps with the arrow keys, and is
// scrubbed by dragging its letter. What is typed belongs to the field until it is taken over.
import { useRef, useState } from 'preact/hooks';
import { useComputed, useSignal } from '@preact/signals';
import { useLiveEffect } from './hooks';
import { useApp } from './app-context';
import {
  fromLength,
  lengthRange,
  lengthStep,
  lengthUnit,
  num,
  parseTyped,
  readTyped,
  toLength,
  type Quantity,
} from '../../model/base/units';
import { TEXTS } from '../../texts/desk/number-field';

export interface NumberFieldProps {
  label: string;
  /** Stands before the number and is dragged to change it. */
  letter?: string;
  unit: () => string;
  /** Of a `length` all numbers here are metres, whatever unit is shown. */
  quantity: () => Quantity;
  step: number;
  /** Value in the shown unit; null when there is nothing to show. */
  value: () => number | null;
  text: () => string;
  /** `live`: one of many values on the way, by a drag or a key that repeats. */
  set: (value: number, live?: boolean) => void;
  /** The least and the greatest value, in the shown unit; what lies outside is not taken. */
  range?: () => readonly [min: number, max: number];
  /** Does the generator decide it? */
  free?: () => boolean;
  /** Is its handle being dragged? */
  live?: () => boolean;
  onUnit?: () => void;
  onFocus?: () => void;
  /** Names the field for keys and tests. */
  field?: string;
}

/** Pixels of drag on the letter for one step. */
const PX_PER_STEP = 2;
/** So long the reason of a refusal stays after the field has been left. */
export const WHY_MS = 4000;

/** How many fields there have been: the page is drawn in several places, and none may take the name of another's. */
let made = 0;

/** Sums of steps are kept free of binary dust. */
const clean = (v: number): number => Number(v.toFixed(6));

/** Who uses a field for a length or an acceleration gives and gets metres; who reads it sees the unit of lengths. */
function inUnitOfLengths(p: NumberFieldProps): NumberFieldProps {
  if (!/^(?:length|acceleration)$/.test(p.quantity()) || lengthUnit() === 'm') return p;
  return {
    ...p,
    step: lengthStep(p.step),
    value: () => {
      const m = p.value();
      return m === null ? null : toLength(m);
    },
    set: (v, live) => p.set(fromLength(v), live),
    range: p.range && (() => lengthRange(p.range!())),
  };
}

export function NumberField(props: NumberFieldProps) {
  const p = inUnitOfLengths(props);
  const { form, editor } = useApp();
  const input = useRef<HTMLInputElement>(null);
  const [id] = useState(() => `number-${++made}`);
  /** Something is typed that has not been taken over. */
  const typed = useRef(false);
  /** Why what was typed is not taken. */
  const bad = useSignal<string | null>(null);
  const shown = useRef<ReturnType<typeof setTimeout> | undefined>(undefined);
  const className = useComputed(() =>
    ['field', p.free?.() && 'free', p.live?.() && 'live', bad.value !== null && 'bad'].filter(Boolean).join(' '),
  );
  const unit = useComputed(p.unit);

  const setTyped = (on: boolean) => {
    typed.current = on;
    input.current!.toggleAttribute('data-typed', on);
  };
  const show = () => {
    setTyped(false);
    clearTimeout(shown.current);
    bad.value = null;
    input.current!.value = p.text();
  };

  useLiveEffect(() => {
    const text = editor.calm.read(p.text);
    const el = input.current!;
    if (typed.current || el.value === text) return;
    el.value = text;
    if (document.activeElement === el) el.select();
  });

  /** Takes over what was typed; false when it cannot be understood. */
  const commit = (): boolean => {
    const text = input.current!.value;
    if (!typed.current) return true;
    const read = text === p.text() ? undefined : readTyped(text, p.quantity());
    const v = read?.(p.value() ?? 0);
    bad.value = read === null ? noNumber(text) : v === undefined ? null : outside(v, p);
    if (bad.value !== null) return false;
    if (v !== undefined) {
      setTyped(false);
      p.set(v);
    }
    show();
    return true;
  };
  /** What could not be taken goes; why it went stays to be read for a while. */
  const leave = () => {
    const why = bad.value;
    show();
    bad.value = why;
    shown.current = setTimeout(() => (bad.value = null), WHY_MS);
  };
  const bump = (d: number) => {
    const now = parseTyped(input.current!.value, p.quantity()) ?? p.value();
    if (now === null) return;
    setTyped(false);
    bad.value = outside(clean(now + d), p);
    if (bad.value !== null) return;
    p.set(clean(now + d), true);
    input.current!.value = p.text();
  };
  /** For fingers, while the field is in use: one step less, one more. */
  const stepper = (by: 1 | -1) =>
    form.touch.value ? (
      <button
        type="button"
        class="stepper"
        tabindex={-1}
        aria-label={`${p.label}, ${by < 0 ? TEXTS.less : TEXTS.more}`}
        onPointerDown={(e) => e.preventDefault()}
        onClick={(e) => {
          e.preventDefault();
          bump(by * p.step);
        }}
      >
        {by < 0 ? '−' : '+'}
      </button>
    ) : null;
  const keyDown = (e: KeyboardEvent) => {
    if (e.key === 'Enter') {
      if (commit()) input.current!.select();
      e.preventDefault();
    } else if (e.key === 'Escape') {
      show();
      input.current!.blur();
      e.stopPropagation();
    } else if (e.key === 'ArrowUp' || e.key === 'ArrowDown') {
      e.preventDefault();
      bump(arrowStep(e, p.step));
    }
  };
  return (
    // Without a name to stand for, a label presses its first button: a step less.
    <label class={className} for={id}>
      {p.letter ? <Scrub letter={p.letter} {...p} /> : null}
      {stepper(-1)}
      <input
        ref={input}
        id={id}
        type="text"
        inputmode="decimal"
        autocomplete="off"
        spellcheck={false}
        aria-label={p.label}
        data-field={p.field}
        onFocus={() => {
          p.onFocus?.();
          input.current!.select();
        }}
        aria-invalid={useComputed(() => (bad.value === null ? null : 'true')) as never}
        onInput={() => {
          setTyped(true);
          bad.value = null;
        }}
        onBlur={() => {
          // A field that is taken off the page with the focus in it hears of that last.
          if (input.current && !commit()) leave();
        }}
        onKeyDown={keyDown}
      />
      {stepper(1)}
      {p.onUnit ? (
        <button
          type="button"
          class="u"
          title={TEXTS.changeTheUnit}
          tabindex={-1}
          onClick={(e) => {
            e.preventDefault();
            p.onUnit!();
          }}
        >
          {unit}
        </button>
      ) : (
        <span class="u">{unit}</span>
      )}
      {bad.value === null ? null : (
        <span class="why" role="alert">
          {bad}
        </span>
      )}
    </label>
  );
}

/** What an arrow key adds: ten steps with Shift, a tenth of one with Alt. */
export const arrowStep = (e: KeyboardEvent, step: number): number =>
  (e.key === 'ArrowUp' ? 1 : -1) * step * (e.shiftKey ? 10 : e.altKey ? 0.1 : 1);

/** Why what was typed cannot be understood. */
export const noNumber = (typed: string): string => TEXTS.isNoNumber(typed.trim().slice(0, 12));

/** In words, why a value is not taken; null where it is. */
export function outside(v: number, p: Pick<NumberFieldProps, 'range' | 'unit'>): string | null {
  if (!Number.isFinite(v)) return TEXTS.notANumber;
  if (!p.range) return null;
  const [min, max] = p.range();
  if (v >= min - 1e-6 && v <= max + 1e-6) return null;
  const text = (n: number): string => num(n, Number.isInteger(Number(n.toFixed(1))) ? 0 : 1);
  return TEXTS.to(text(min), text(max), p.unit()).trim();
}

type ScrubProps = Pick<NumberFieldProps, 'value' | 'step' | 'set' | 'range'> & { letter: string; class?: string };

/** The letter or the name of a field, which is dragged to change the number. */
export function Scrub({ letter, value, step, set, range, class: className = 'k' }: ScrubProps) {
  const from = useRef<{ x: number; v: number } | null>(null);
  const within = (v: number): number => {
    const [min, max] = range?.() ?? [-Infinity, Infinity];
    return Math.min(max, Math.max(min, v));
  };
  return (
    <span
      class={className}
      title={TEXTS.dragToChange}
      onPointerDown={(e) => {
        const v = value();
        if (v === null || e.button !== 0) return;
        e.preventDefault();
        from.current = { x: e.clientX, v };
        e.currentTarget.setPointerCapture(e.pointerId);
      }}
      onPointerMove={(e) => {
        if (!from.current) return;
        const steps = Math.round((e.clientX - from.current.x) / PX_PER_STEP);
        const next = within(clean(from.current.v + steps * step * (e.shiftKey ? 10 : e.altKey ? 0.1 : 1)));
        if (next !== value()) set(next, true);
      }}
      onPointerUp={() => {
        from.current = null;
      }}
      onPointerCancel={() => {
        from.current = null;
      }}
      onClick={(e) => e.preventDefault()}
    >
      {letter}
    </span>
  );
}
