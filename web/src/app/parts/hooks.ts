// What components do with signals beyond reading them.
import type { RefObject } from 'preact';
import { useEffect, useLayoutEffect, useRef, useState } from 'preact/hooks';
import { effect, signal, type ReadonlySignal } from '@preact/signals';

/** Runs when the component is on the page, before it is painted, and again whenever a signal it read changes. */
export function useLiveEffect(run: () => void): void {
  const latest = useRef(run);
  latest.current = run;
  useLayoutEffect(() => effect(() => latest.current()), []);
}

/**
 * A count that rises when something `read` looks at has changed, at most once a frame: for what is dear to draw,
 * while signals change several times a frame.
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
 * A press beside what is open closes it; one on an element with the data that is spared is left to it. A finger on the
 * picture means no more than that, and takes hold of nothing there.
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
