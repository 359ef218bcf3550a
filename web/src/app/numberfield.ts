// A field for one number: shows what the handle shows, takes sums and units, steps with the arrow keys, and is
// scrubbed by dragging its label.
import { h, watch } from './dom';
import { parseTyped, type Quantity } from '../model/units';

export interface NumberFieldSpec {
  label: string;
  letter?: string;
  unit: string | (() => string);
  quantity: () => Quantity;
  step: number;
  decimals: () => number;
  /** Value in the shown unit; null when there is nothing to show. */
  value: () => number | null;
  text: () => string;
  free: () => boolean;
  live?: () => boolean;
  set: (value: number) => void;
  onUnit?: () => void;
  onFocus?: () => void;
  field?: string;
}

export function numberField(s: NumberFieldSpec): HTMLElement {
  /** Something is typed that has not been taken over. */
  let editing = false;
  const typed = (on: boolean) => {
    editing = on;
    input.toggleAttribute('data-typed', on);
  };
  const input = h('input', {
    type: 'text',
    inputmode: 'decimal',
    autocomplete: 'off',
    spellcheck: 'false',
    'aria-label': s.label,
    'data-field': s.field ?? null,
  });
  const unitText = () => (typeof s.unit === 'function' ? s.unit() : s.unit);
  const box = h(
    'label',
    { class: () => `field ${s.free() ? 'free' : ''} ${s.live?.() ? 'live' : ''}` },
    s.letter ? h('span', { class: 'k', title: 'Drag to change' }, s.letter) : null,
    input,
    s.onUnit
      ? h(
          'button',
          {
            type: 'button',
            class: 'u',
            title: 'Change the unit',
            tabindex: '-1',
            onclick: (e: Event) => {
              e.preventDefault();
              s.onUnit!();
            },
          },
          unitText,
        )
      : h('span', { class: 'u' }, unitText),
  );
  watch(() => {
    const t = s.text();
    if (editing || input.value === t) return;
    input.value = t;
    if (document.activeElement === input) input.select();
  });
  const show = () => {
    typed(false);
    box.classList.remove('bad');
    input.value = s.text();
  };
  const commit = (): boolean => {
    if (!editing) return true;
    if (input.value === s.text()) {
      show();
      return true;
    }
    const v = parseTyped(input.value, s.quantity());
    if (v === null) {
      box.classList.add('bad');
      return false;
    }
    typed(false);
    box.classList.remove('bad');
    s.set(v);
    input.value = s.text();
    return true;
  };
  const bump = (d: number) => {
    const now = parseTyped(input.value, s.quantity()) ?? s.value();
    if (now === null) return;
    typed(false);
    s.set(Number((now + d).toFixed(6)));
    input.value = s.text();
  };
  input.addEventListener('focus', () => {
    s.onFocus?.();
    input.select();
  });
  input.addEventListener('input', () => {
    typed(true);
    box.classList.remove('bad');
  });
  input.addEventListener('blur', () => {
    if (!commit()) show();
  });
  input.addEventListener('keydown', (e) => {
    if (e.key === 'Enter') {
      if (commit()) input.select();
      e.preventDefault();
    } else if (e.key === 'Escape') {
      show();
      input.blur();
      e.stopPropagation();
    } else if (e.key === 'ArrowUp' || e.key === 'ArrowDown') {
      e.preventDefault();
      bump((e.key === 'ArrowUp' ? 1 : -1) * s.step * (e.shiftKey ? 10 : e.altKey ? 0.1 : 1));
    }
  });
  scrub(box.querySelector('.k'), s);
  return box;
}

function scrub(handle: Element | null, s: NumberFieldSpec): void {
  if (!(handle instanceof HTMLElement)) return;
  let from: { x: number; v: number } | null = null;
  handle.addEventListener('pointerdown', (e) => {
    const v = s.value();
    if (v === null) return;
    e.preventDefault();
    from = { x: e.clientX, v };
    handle.setPointerCapture(e.pointerId);
  });
  handle.addEventListener('pointermove', (e) => {
    if (!from) return;
    const d = Math.round((e.clientX - from.x) / 2);
    if (d) s.set(Number((from.v + d * s.step).toFixed(6)));
  });
  handle.addEventListener('pointerup', () => {
    from = null;
  });
  handle.addEventListener('click', (e) => e.preventDefault());
}
