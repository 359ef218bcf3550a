// Automatic follow-ups: the crash report, the wait for an unreachable server.
import type { Opening } from '../actions/context';

/** An uncaught error is reported once; changes are saved already. */
export function reportCrashes({ editor }: Opening): void {
  addEventListener('error', (e) => {
    if (e.error) editor.notices.crashed(e.error);
  });
  addEventListener('unhandledrejection', (e) => {
    if ((e.reason as Error | null)?.name !== 'AbortError') editor.notices.crashed(e.reason);
  });
}

const RETRY_S = [1, 2, 4, 6];

/** Without the server there is nothing to show: it is polled at growing intervals, then the page starts again. */
export function waitForServer(c: Opening, tries = 0): void {
  const { answers } = c.editor;
  let left = RETRY_S[Math.min(tries, RETRY_S.length - 1)];
  answers.report({ kind: 'away' });
  answers.missing({ retryIn: left, waiting: 0 });
  const timer = setInterval(() => {
    left--;
    answers.missing({ retryIn: Math.max(0, left), waiting: 0 });
    if (left > 0) return;
    clearInterval(timer);
    void c.client.answers().then((yes) => (yes ? location.reload() : waitForServer(c, tries + 1)));
  }, 1000);
}
