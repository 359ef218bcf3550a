// Buttons made from the action registry: label, key, icon, enabled state and reason all come from there.
import type { ComponentChildren } from 'preact';
import { useComputed } from '@preact/signals';
import { actionOf, perform, possible } from '../../actions/registry';
import { caps } from '../../actions/keys';
import { useApp } from './app-context';
import { Icon } from './icons';

/** The caps of a key, as in the shortcut sheet. */
export function KeyCaps({ of }: { of: string }) {
  return (
    <>
      {caps(of).map((k) => (
        <kbd key={k}>{k}</kbd>
      ))}
    </>
  );
}

export function titleOf(id: string): string {
  const a = actionOf(id);
  return a.keys?.[0] ? `${a.label} (${caps(a.keys[0]).join(' ')})` : a.label;
}

interface ActionButtonProps {
  id: string;
  class?: string;
  /** Another icon than the action's; empty for none. */
  icon?: string;
  size?: number;
  /** Shows the first key of the action. */
  withKey?: boolean;
  iconOnly?: boolean;
  /** Replaces the action's label. */
  children?: ComponentChildren;
  /** Content after everything else. */
  after?: ComponentChildren;
}

export function ActionButton({ id, size = 18, iconOnly, withKey, ...look }: ActionButtonProps) {
  const c = useApp();
  const a = actionOf(id);
  const can = useComputed(() => possible(c, a));
  const on = useComputed(() => a.checked?.(c) ?? false);
  const title = useComputed(() => (can.value === true ? titleOf(id) : `${a.label}: ${can.value}`));
  const disabled = useComputed(() => (can.value === true ? null : 'true'));
  const pressed = useComputed(() => (a.checked ? String(on.value) : null));
  const className = useComputed(() =>
    ['btn', iconOnly && 'i', look.class, can.value !== true && 'off', on.value && 'on'].filter(Boolean).join(' '),
  );
  const icon = look.icon ?? a.icon;
  const key = withKey ? a.keys?.[0] : undefined;
  return (
    <button
      type="button"
      data-action={id}
      aria-label={iconOnly ? a.label : undefined}
      title={title}
      aria-disabled={disabled as never}
      aria-pressed={pressed as never}
      class={className}
      onClick={() => perform(c, id)}
    >
      {icon ? <Icon name={icon} size={size} /> : null}
      {iconOnly ? look.children : (look.children ?? a.label)}
      {key ? <KeyCaps of={key} /> : null}
      {look.after}
    </button>
  );
}

export const IconButton = (props: Omit<ActionButtonProps, 'iconOnly'>) => <ActionButton {...props} iconOnly />;

/** A group of mutually exclusive actions, as pairs of id and text. */
export function Segments({ label, items }: { label: string; items: readonly (readonly [string, string])[] }) {
  return (
    <div class="seg" role="group" aria-label={label}>
      {items.map(([id, text]) => (
        <ActionButton key={id} id={id}>
          {text}
        </ActionButton>
      ))}
    </div>
  );
}
