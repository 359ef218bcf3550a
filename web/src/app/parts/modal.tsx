// A modal dialog: it traps the focus and returns it on Esc.
import type { ComponentChildren } from 'preact';
import { useLayoutEffect, useRef } from 'preact/hooks';

interface ModalProps {
  label: string;
  class: string;
  close: () => void;
  children: ComponentChildren;
}

export function Modal({ label, class: className, close, children }: ModalProps) {
  const scrim = useRef<HTMLDivElement>(null);
  const back = useRef<HTMLElement | null>(null);
  const inside = () =>
    [...scrim.current!.querySelectorAll<HTMLElement>('button, input, select, [tabindex="0"]')].filter(
      (e) => e.offsetParent,
    );

  useLayoutEffect(() => {
    back.current = document.activeElement as HTMLElement | null;
    (scrim.current!.querySelector<HTMLElement>('[data-first]') ?? inside()[0])?.focus();
  }, []);

  const keyDown = (e: KeyboardEvent) => {
    if (e.key === 'Escape') {
      e.stopPropagation();
      close();
      back.current?.focus?.();
    }
    if (e.key !== 'Tab') return;
    e.preventDefault();
    e.stopPropagation();
    const items = inside();
    const at = items.indexOf(document.activeElement as HTMLElement);
    items[(at + (e.shiftKey ? -1 : 1) + items.length) % items.length]?.focus();
  };
  return (
    <div
      ref={scrim}
      class="scrim"
      onKeyDown={keyDown}
      onPointerDown={(e) => {
        if (e.target === scrim.current) close();
      }}
    >
      <section class={`dlg ${className}`} role="dialog" aria-modal="true" aria-label={label}>
        {children}
      </section>
    </div>
  );
}
