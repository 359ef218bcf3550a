// A live region for events. Polite, at most one message a second, the newest wins; collisions and a missing generator
// are announced at once.
import { useRef } from 'preact/hooks';
import { useApp } from '../parts/app-context';
import { useLiveEffect } from '../parts/hooks';

const BETWEEN_MS = 1000;

export function LiveRegion() {
  const { notices } = useApp().editor;
  const polite = useRef<HTMLDivElement>(null);
  const urgent = useRef<HTMLDivElement>(null);
  const last = useRef(0);
  const timer = useRef<ReturnType<typeof setTimeout> | undefined>(undefined);
  useLiveEffect(() => {
    const { text, urgent: now } = notices.spoken.value;
    if (!text) return;
    if (now) {
      urgent.current!.textContent = text;
      return;
    }
    clearTimeout(timer.current);
    timer.current = setTimeout(
      () => {
        last.current = performance.now();
        polite.current!.textContent = text;
      },
      Math.max(0, last.current + BETWEEN_MS - performance.now()),
    );
  });
  return (
    <>
      <div ref={polite} class="sr" role="status" aria-live="polite" />
      <div ref={urgent} class="sr" role="alert" aria-live="assertive" />
    </>
  );
}
