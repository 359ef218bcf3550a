// Hooks for signals beyond reading them.
import type { RefObject } from 'preact';
import { useEffect, useLayoutEffect, useRef, useState } from 'preact/hooks';
import { effect, signal, type ReadonlySignal } from '@preact/signals';

/** Runs when the component is mounted, before painting, and again whenever a signal it read changes. */
export function useLiveEffect(run: () => void): void {
  const latest = useRef(run);
  latest.current = run;
  useLayoutEffect(() => effect(() => latest.current()), []);
}

/**
 * A count that increases when a signal of `read` has changed, at most once a frame: for costly drawings, while signals
 * change several times a frame.
 */
export function useFrameTick(read: () => unknown): ReadonlySignal<number> {
  const [tick] = useState(() => signal(0));
  const frame = useRef(0);
  useLiveEffect(() => {
    read();
    if (frame.current) return;
    frame.current = requestAnimationFrame(() => {
      frame.current = 0;
      tick.value = tick.peek() + 1;
    });
  });
  useLayoutEffect(() => () => cancelAnimationFrame(frame.current), []);
  return tick;
}

/**
 * A press outside an open box closes it; elements with the spared data attribute are excluded. A finger on the picture
 * only closes it, and grabs nothing there.
 */
export function usePressBeside(box: RefObject<Element | null>, close: () => void, spared?: string): void {
  const latest = useRef(close);
  latest.current = close;
  useEffect(() => {
    const press = (e: PointerEvent) => {
      const at = e.target as Element;
      if (box.current?.contains(at) || (spared && at.closest(`[data-${spared}]`))) return;
      latest.current();
      if (e.pointerType === 'touch' && at.matches('.stage, canvas')) e.stopPropagation();
    };
    addEventListener('pointerdown', press, true);
    return () => removeEventListener('pointerdown', press, true);
  }, [box, spared]);
}
