// What components do with signals beyond reading them.
import { useLayoutEffect, useRef, useState } from 'preact/hooks';
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
