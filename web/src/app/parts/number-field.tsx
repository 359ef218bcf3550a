// A field for one number: shows the handle's value, accepts sums and units, steps with arrow keys, and is scrubbed by
// dragging its letter. Typed text belongs to the field until it is committed.
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
  /** Letter before the number, dragged to change it. */
  letter?: string;
  unit: () => string;
  /** For a `length` all numbers here are metres, whatever unit is shown. */
  quantity: () => Quantity;
  step: number;
  /** Value in the shown unit; null when there is none. */
  value: () => number | null;
  text: () => string;
  /** `live`: an intermediate value, from a drag or a repeating key. */
  set: (value: number, live?: boolean) => void;
  /** The accepted range, in the shown unit; values outside are refused. */
  range?: () => readonly [min: number, max: number];
  /** Takes a text that is no number: true if it was applied, a sentence if it is refused, null if unknown. */
  words?: (text: string) => true | string | null;
  /** Is the value free? */
  free?: () => boolean;
  /** Is its handle being dragged? */
  live?: () => boolean;
  onUnit?: () => void;
  onFocus?: () => void;
  /** Identifies the field for keys and tests. */
  field?: string;
}

/** Pixels of drag on the letter for one step. */
const PX_PER_STEP = 2;
/** Time that a refusal's reason stays after the field is left. */
export const WHY_MS = 4000;

/** Number of fields so far: the page has several roots, and ids must be unique. */
let made = 0;

/** Removes floating-point residue from sums of steps. */
const clean = (v: number): number => Number(v.toFixed(6));

/** A field for lengths or accelerations is used in metres and displayed in the unit of lengths. */
function inUnitOfLengths(p: NumberFieldProps): NumberFieldProps {
  if (!['length', 'acceleration'].includes(p.quantity()) || lengthUnit() === 'm') return p;
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

/** Typed text of a field until it is committed, and why it was refused. */
function useTyped(p: NumberFieldProps) {
  const input = useRef<HTMLInputElement>(null);
  /** There is typed text that is not committed. */
  const typed = useRef(false);
  /** Why typed text is refused. */
  const bad = useSignal<string | null>(null);
  const shown = useRef<ReturnType<typeof setTimeout> | undefined>(undefined);

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
  return {
    input,
    typed,
    bad,
    show,
    /** The user typed: the reason of a refusal goes. */
    type: () => {
      setTyped(true);
      bad.value = null;
    },
    /** Commits typed text; false when it cannot be parsed. */
    commit: (): boolean => {
      const text = input.current!.value;
      if (!typed.current) return true;
      const read = text === p.text() ? undefined : readTyped(text, p.quantity());
      const v = read?.(p.value() ?? 0);
      const why = read === null ? (p.words?.(text) ?? noNumber(text)) : v === undefined ? null : outside(v, p);
      bad.value = why === true ? null : why;
      if (bad.value !== null) return false;
      if (v !== undefined) {
        setTyped(false);
        p.set(v);
      }
      show();
      return true;
    },
    /** Refused text is removed; its reason stays visible for a while. */
    leave: () => {
      const why = bad.value;
      show();
      bad.value = why;
      shown.current = setTimeout(() => (bad.value = null), WHY_MS);
    },
    /** Adds to the number in the field. */
    bump: (d: number) => {
      const now = parseTyped(input.current!.value, p.quantity()) ?? p.value();
      if (now === null) return;
      setTyped(false);
      bad.value = outside(clean(now + d), p);
      if (bad.value !== null) return;
      p.set(clean(now + d), true);
      input.current!.value = p.text();
    },
  };
}

export function NumberField(props: NumberFieldProps) {
  const p = inUnitOfLengths(props);
  const { form, editor } = useApp();
  const [id] = useState(() => `number-${++made}`);
  const { input, typed, bad, show, type, commit, leave, bump } = useTyped(p);
  const className = useComputed(() =>
    ['field', p.free?.() && 'free', p.live?.() && 'live', bad.value !== null && 'bad'].filter(Boolean).join(' '),
  );

  useLiveEffect(() => {
    const text = editor.reading.throttle.read(p.text);
    const el = input.current!;
    if (typed.current || el.value === text) return;
    el.value = text;
    if (document.activeElement === el) el.select();
  });

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
  const stepper = (by: 1 | -1) =>
    form.touch.value ? <Stepper by={by} label={p.label} press={() => bump(by * p.step)} /> : null;
  return (
    // Without a target, a label presses its first button: a step less.
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
        onInput={type}
        onBlur={() => {
          // A focused field that is unmounted gets no blur event.
          if (input.current && !commit()) leave();
        }}
        onKeyDown={keyDown}
      />
      {stepper(1)}
      <UnitOfField unit={p.unit} change={p.onUnit} />
      {bad.value === null ? null : (
        <span class="why" role="alert">
          {bad}
        </span>
      )}
    </label>
  );
}

/** For fingers, while the field is in use: one step less or one more. */
function Stepper({ by, label, press }: { by: 1 | -1; label: string; press: () => void }) {
  return (
    <button
      type="button"
      class="stepper"
      tabindex={-1}
      aria-label={`${label}, ${by < 0 ? TEXTS.less : TEXTS.more}`}
      onPointerDown={(e) => e.preventDefault()}
      onClick={(e) => {
        e.preventDefault();
        press();
      }}
    >
      {by < 0 ? '−' : '+'}
    </button>
  );
}

/** The unit behind the number; a button where it can be changed. */
function UnitOfField({ unit: unitNow, change }: { unit: () => string; change?: () => void }) {
  const unit = useComputed(unitNow);
  if (!change) return <span class="u">{unit}</span>;
  return (
    <button
      type="button"
      class="u"
      title={TEXTS.changeTheUnit}
      tabindex={-1}
      onClick={(e) => {
        e.preventDefault();
        change();
      }}
    >
      {unit}
    </button>
  );
}

/** Step of an arrow key: ten steps with Shift, a tenth with Alt. */
export const arrowStep = (e: KeyboardEvent, step: number): number =>
  (e.key === 'ArrowUp' ? 1 : -1) * step * (e.shiftKey ? 10 : e.altKey ? 0.1 : 1);

/** Why typed text cannot be parsed. */
export const noNumber = (typed: string): string => TEXTS.isNoNumber(typed.trim().slice(0, 12));

/** Why a value is refused, in words; null where it is accepted. */
export function outside(v: number, p: Pick<NumberFieldProps, 'range' | 'unit'>): string | null {
  if (!Number.isFinite(v)) return TEXTS.notANumber;
  if (!p.range) return null;
  const [min, max] = p.range();
  if (v >= min - 1e-6 && v <= max + 1e-6) return null;
  const text = (n: number): string => num(n, Number.isInteger(Number(n.toFixed(1))) ? 0 : 1);
  return TEXTS.to(text(min), text(max), p.unit()).trim();
}

type ScrubProps = Pick<NumberFieldProps, 'value' | 'step' | 'set' | 'range'> & { letter: string; class?: string };

/** The letter or the name of a field, dragged to change the number. */
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
