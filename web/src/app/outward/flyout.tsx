// A panel under its button in the top bar. It closes on Esc and on a click outside, and returns the focus.
import type { ComponentChildren } from 'preact';
import { useEffect, useLayoutEffect, useRef } from 'preact/hooks';
import { useApp } from '../parts/app-context';

interface FlyoutProps {
  label: string;
  /** Id of the action of its button. */
  under: string;
  class: string;
  children: ComponentChildren;
}

export function Flyout({ label, under, class: className, children }: FlyoutProps) {
  const { ui } = useApp();
  const box = useRef<HTMLElement>(null);
  const button = () => document.querySelector<HTMLElement>(`.top [data-action="${under}"]`);
  useLayoutEffect(() => {
    const back = document.activeElement as HTMLElement | null;
    (box.current!.querySelector<HTMLElement>('[data-first]') ?? box.current!).focus({ preventScroll: true });
    return () => (back?.isConnected ? back : button())?.focus?.();
  }, []);
  useEffect(() => {
    const beside = (e: Event) => {
      const at = e.target as Element;
      if (!box.current?.contains(at) && !button()?.contains(at)) ui.closeDialog();
    };
    addEventListener('pointerdown', beside, true);
    return () => removeEventListener('pointerdown', beside, true);
  }, [ui]);
  const right = Math.max(8, innerWidth - (button()?.getBoundingClientRect().right ?? innerWidth));
  return (
    <section
      ref={box}
      class={`flyout ${className}`}
      role="dialog"
      aria-label={label}
      tabIndex={-1}
      style={{ '--under': `${right}px` }}
      onKeyDown={(e) => {
        if (e.key !== 'Escape') return;
        e.stopPropagation();
        ui.closeDialog();
      }}
    >
      {children}
    </section>
  );
}
