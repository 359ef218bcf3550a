// A list of actions that opens: it takes the focus, arrows walk in it, and a choice or an outside press closes it.
import type { ComponentChildren } from 'preact';
import { useLayoutEffect, useRef } from 'preact/hooks';
import { useApp } from './app-context';
import { usePressBeside } from './hooks';

interface MenuListProps {
  readonly label?: string;
  readonly class?: string;
  readonly style?: Record<string, string>;
  /** Does it stay open after a choice? */
  readonly stays?: boolean;
  readonly children: ComponentChildren;
}

export function MenuList({ label, class: className, style, stays = false, children }: MenuListProps) {
  const { ui } = useApp();
  const box = useRef<HTMLDivElement>(null);
  const items = () => [...box.current!.querySelectorAll<HTMLElement>('button')];

  useLayoutEffect(() => items()[0]?.focus({ preventScroll: true }), []);
  usePressBeside(box, () => ui.closeMenu(), 'menu');

  const step = (e: KeyboardEvent) => {
    if (e.key !== 'ArrowDown' && e.key !== 'ArrowUp') return;
    e.preventDefault();
    const all = items();
    const at = all.indexOf(document.activeElement as HTMLElement);
    all[(at + (e.key === 'ArrowDown' ? 1 : -1) + all.length) % all.length]?.focus();
  };
  const choose = (e: Event) => {
    if (!stays && (e.target as Element).closest('[data-action]')) ui.closeMenu();
  };
  return (
    <div
      ref={box}
      class={['menu', className].filter(Boolean).join(' ')}
      role="menu"
      aria-label={label}
      style={style}
      onClick={choose}
      onKeyDown={step}
    >
      {children}
    </div>
  );
}
