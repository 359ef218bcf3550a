// A field for one number: shows what the handle shows, takes sums and units, steps with the arrow keys, and is
// scrubbed by dragging its letter. What is typed belongs to the field until it is taken over.
import { useRef } from 'preact/hooks';
import { useComputed, useSignal } from '@preact/signals';
import { useLiveEffect } from './hooks';
import { parseTyped, type Quantity } from '../../model/units';

export interface NumberFieldProps {
  label: string;
  /** Stands before the number and is dragged to change it. */
  letter?: string;
  unit: () => string;
  quantity: () => Quantity;
  step: number;
  /** Value in the shown unit; null when there is nothing to show. */
  value: () => number | null;
  text: () => string;
  set: (value: number) => void;
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

/** Sums of steps are kept free of binary dust. */
const clean = (v: number): number => Number(v.toFixed(6));

export function NumberField(p: NumberFieldProps) {
  const input = useRef<HTMLInputElement>(null);
  /** Something is typed that has not been taken over. */
  const typed = useRef(false);
  const bad = useSignal(false);
  const className = useComputed(() =>
    ['field', p.free?.() && 'free', p.live?.() && 'live', bad.value && 'bad'].filter(Boolean).join(' '),
  );
  const unit = useComputed(p.unit);

  const setTyped = (on: boolean) => {
    typed.current = on;
    input.current!.toggleAttribute('data-typed', on);
  };
  const show = () => {
    setTyped(false);
    bad.value = false;
    input.current!.value = p.text();
  };

  useLiveEffect(() => {
    const text = p.text();
    const el = input.current!;
    if (typed.current || el.value === text) return;
    el.value = text;
    if (document.activeElement === el) el.select();
  });

  /** Takes over what was typed; false when it cannot be understood. */
  const commit = (): boolean => {
    const text = input.current!.value;
    if (!typed.current) return true;
    const v = text === p.text() ? undefined : parseTyped(text, p.quantity());
    bad.value = v === null;
    if (v === null) return false;
    if (v !== undefined) {
      setTyped(false);
      p.set(v);
    }
    show();
    return true;
  };
  const bump = (d: number) => {
    const now = parseTyped(input.current!.value, p.quantity()) ?? p.value();
    if (now === null) return;
    setTyped(false);
    p.set(clean(now + d));
    input.current!.value = p.text();
  };
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
      bump((e.key === 'ArrowUp' ? 1 : -1) * p.step * (e.shiftKey ? 10 : e.altKey ? 0.1 : 1));
    }
  };
  return (
    <label class={className}>
      {p.letter ? <Scrub letter={p.letter} value={p.value} step={p.step} set={p.set} /> : null}
      <input
        ref={input}
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
        onInput={() => {
          setTyped(true);
          bad.value = false;
        }}
        onBlur={() => {
          if (!commit()) show();
        }}
        onKeyDown={keyDown}
      />
      {p.onUnit ? (
        <button
          type="button"
          class="u"
          title="Change the unit"
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
    </label>
  );
}

/** The letter of a field, which is dragged to change the number. */
function Scrub({ letter, value, step, set }: Pick<NumberFieldProps, 'value' | 'step' | 'set'> & { letter: string }) {
  const from = useRef<{ x: number; v: number } | null>(null);
  return (
    <span
      class="k"
      title="Drag to change"
      onPointerDown={(e) => {
        const v = value();
        if (v === null) return;
        e.preventDefault();
        from.current = { x: e.clientX, v };
        e.currentTarget.setPointerCapture(e.pointerId);
      }}
      onPointerMove={(e) => {
        if (!from.current) return;
        const steps = Math.round((e.clientX - from.current.x) / PX_PER_STEP);
        if (steps) set(clean(from.current.v + steps * step));
      }}
      onPointerUp={() => {
        from.current = null;
      }}
      onClick={(e) => e.preventDefault()}
    >
      {letter}
    </span>
  );
}
