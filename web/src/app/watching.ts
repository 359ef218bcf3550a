// Automatic follow-ups: the first-minute hint, the crash report, the wait for an unreachable server.
import { effect } from '@preact/signals-core';
import type { Opening } from '../actions/context';
import { hasGoal } from '../model/document/scene';

/** The three-step hint follows the user's actions and closes for good after the first drop. */
export function coach({ editor, ui }: Opening): void {
  let opened = ui.drawer.peek() === 'scenes';
  effect(() => {
    const a = editor.agent.value;
    const dragging = editor.drag.active.value;
    if (a && opened) {
      opened = false;
      if (ui.drawer.peek() === 'scenes') ui.showDrawer(null);
    }
    if (!ui.coach.peek()) return;
    if (ui.coach.peek() === 1 && a) ui.coachTo(2);
    if (ui.coach.peek() === 2 && !a && !dragging) ui.coachTo(1);
    if (ui.coach.peek() === 2 && dragging) ui.coachTo(3);
    // A goal set by keys makes the drag hint unnecessary.
    if (ui.coach.peek() > 1 && !dragging && a && hasGoal(a.goal)) ui.endCoach();
  });
}

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
