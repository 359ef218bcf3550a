// The step of the first-minute hint.
import { effect } from '@preact/signals-core';
import type { Opening } from '../actions/context';
import { hasGoal } from '../model/document/scene';

/** The three-step hint follows the user's actions and closes for good after the first drop. */
export function coach({ editor, ui }: Pick<Opening, 'editor' | 'ui'>): void {
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
    // A cancelled drag leaves no goal.
    if (ui.coach.peek() === 3 && !dragging) ui.coachTo(2);
    if (ui.coach.peek() === 2 && !a && !dragging) ui.coachTo(1);
    if (ui.coach.peek() === 2 && dragging) ui.coachTo(3);
    // A goal set by keys makes the drag hint unnecessary.
    if (ui.coach.peek() > 1 && !dragging && a && hasGoal(a.goal)) ui.endCoach();
  });
}
