// Buttons made from the action registry: label, key, icon, enabled state and reason all come from there.
import type { Context } from '../actions/context';
import { actionOf, perform, possible } from '../actions/registry';
import { caps } from '../actions/keys';
import { h, type Child, type Props } from './dom';
import { icon } from './icons';

export const keyCaps = (key: string): HTMLElement[] => caps(key).map((k) => h('kbd', null, k));

export function titleOf(id: string): string {
  const a = actionOf(id);
  return a.keys?.[0] ? `${a.label} (${caps(a.keys[0]).join(' ')})` : a.label;
}

interface Look {
  class?: string | (() => string);
  icon?: string;
  size?: number;
  label?: Child;
  key?: boolean;
  iconOnly?: boolean;
}

export function actionButton(c: Context, id: string, look: Look = {}): HTMLButtonElement {
  const a = actionOf(id);
  const can = () => possible(c, a);
  const name = look.icon ?? a.icon;
  const props: Props = {
    type: 'button',
    'data-action': id,
    'aria-label': look.iconOnly ? a.label : null,
    title: () => {
      const r = can();
      return r === true ? titleOf(id) : `${a.label}: ${r}`;
    },
    'aria-disabled': () => (can() === true ? null : 'true'),
    'aria-pressed': a.checked ? () => String(a.checked!(c)) : null,
    class: () =>
      `btn ${look.iconOnly ? 'i ' : ''}${typeof look.class === 'function' ? look.class() : (look.class ?? '')}${can() === true ? '' : ' off'}${a.checked?.(c) ? ' on' : ''}`,
    onclick: () => perform(c, id),
  };
  return h(
    'button',
    props,
    name ? icon(name, look.size ?? 18) : null,
    look.iconOnly ? null : (look.label ?? a.label),
    look.key && a.keys?.[0] ? keyCaps(a.keys[0]) : null,
  );
}

export const iconButton = (c: Context, id: string, look: Look = {}): HTMLButtonElement =>
  actionButton(c, id, { ...look, iconOnly: true });

/** A group of mutually exclusive actions. */
export function segments(c: Context, label: string, items: readonly (readonly [string, string])[]): HTMLElement {
  return h(
    'div',
    { class: 'seg', role: 'group', 'aria-label': label },
    items.map(([id, text]) => actionButton(c, id, { label: text })),
  );
}
