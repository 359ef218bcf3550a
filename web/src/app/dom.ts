// A small helper for building panels: functions as values follow signals and write single attributes or texts.
import { effect, untracked } from '@preact/signals-core';

export type Child =
  | Node
  | string
  | number
  | null
  | undefined
  | false
  | (() => string | number | Node | null | undefined | false)
  | Child[];
type Value = string | number | boolean | null | undefined;
export type Props = Record<string, unknown> & {
  css?: Record<string, string | (() => string)>;
  class?: string | (() => string);
};

let scope: (() => void)[] | null = null;

/** Builds something; `dispose` ends every effect that was started inside. */
export function scoped<T>(build: () => T): { value: T; dispose: () => void } {
  const outer = scope;
  const mine: (() => void)[] = (scope = []);
  try {
    return {
      value: build(),
      dispose: () => {
        for (const end of mine) end();
        mine.length = 0;
      },
    };
  } finally {
    scope = outer;
  }
}

export function watch(run: () => void): void {
  const end = effect(run);
  scope?.push(end);
}

export function onEnd(run: () => void): void {
  scope?.push(run);
}

const SVG = 'http://www.w3.org/2000/svg';

export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  props?: Props | null,
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const el = document.createElement(tag);
  apply(el, props);
  append(el, children);
  return el;
}

export function svg(tag: string, props?: Props | null, ...children: Child[]): SVGElement {
  const el = document.createElementNS(SVG, tag) as SVGElement;
  apply(el, props);
  append(el, children);
  return el;
}

function apply(el: HTMLElement | SVGElement, props?: Props | null): void {
  if (!props) return;
  for (const [name, value] of Object.entries(props)) {
    if (name === 'css') applyStyle(el, value as Record<string, string | (() => string)>);
    else if (name.startsWith('on') && typeof value === 'function')
      el.addEventListener(name.slice(2), value as EventListener);
    else if (typeof value === 'function') watch(() => set(el, name, (value as () => Value)()));
    else set(el, name, value as Value);
  }
}

/** Styles go through the object model: the page's security policy refuses style attributes. */
function applyStyle(el: HTMLElement | SVGElement, css: Record<string, string | (() => string)>): void {
  for (const [name, value] of Object.entries(css)) {
    if (typeof value === 'function') watch(() => el.style.setProperty(name, value()));
    else el.style.setProperty(name, value);
  }
}

function set(el: HTMLElement | SVGElement, name: string, value: Value): void {
  if (name === 'value' && el instanceof HTMLInputElement) {
    if (el.value !== String(value ?? '')) el.value = String(value ?? '');
    return;
  }
  if (value === false || value === null || value === undefined) el.removeAttribute(name);
  else el.setAttribute(name, value === true ? '' : String(value));
}

function append(el: Node, children: Child[]): void {
  for (const c of children) {
    if (c === null || c === undefined || c === false) continue;
    if (Array.isArray(c)) append(el, c);
    else if (typeof c === 'function') appendLive(el, c);
    else el.appendChild(c instanceof Node ? c : document.createTextNode(String(c)));
  }
}

function appendLive(el: Node, make: () => string | number | Node | null | undefined | false): void {
  let now: Node = document.createTextNode('');
  el.appendChild(now);
  watch(() => {
    const v = make();
    if (v instanceof Node) {
      if (v !== now) {
        now.parentNode?.replaceChild(v, now);
        now = v;
      }
      return;
    }
    const text = v === null || v === undefined || v === false ? '' : String(v);
    if (now.nodeType === Node.TEXT_NODE) {
      if (now.nodeValue !== text) now.nodeValue = text;
    } else {
      const t = document.createTextNode(text);
      now.parentNode?.replaceChild(t, now);
      now = t;
    }
  });
}

/** A place whose content is built anew whenever the key changes. */
export function swap(key: () => unknown, build: () => Node | null): Node {
  const holder = h('div', { class: 'swap' });
  let old: unknown = {};
  let dispose: (() => void) | null = null;
  watch(() => {
    const k = key();
    if (k === old) return;
    old = k;
    dispose?.();
    const made = untracked(() => scoped(build));
    dispose = made.dispose;
    holder.replaceChildren(...(made.value ? [made.value] : []));
  });
  onEnd(() => dispose?.());
  return holder;
}
