// The hint of the first minute.
import type { Context } from '../../actions/context';
import { placedBy } from '../../actions/place';
import { FLAG_HEIGHT } from '../../draw/handles';
import { poseShown } from '../../edit/frame';
import { useApp } from '../parts/app-context';
import { useComputed } from '@preact/signals';
import { Icon } from '../parts/icons';
import { viewTick } from './view-tick';
import { TEXTS } from '../../texts/desk/hud';

const STEPS = [TEXTS.clickACar, TEXTS.dragItsFlagTo, TEXTS.letGoTheOthers];
/** How far the hint reaches to both sides of the middle, with all steps and with one, and up or down from its edge. */
const HALF_WIDTH_PX = 340;
const HALF_STEP_PX = 200;
const REACHES_PX = 120;
const REACHES_DOWN_PX = 150;

export function Coach() {
  const c = useApp();
  const { editor, rounds, searching, ui, variants } = c;
  const shown = useComputed(
    () =>
      ui.coach.value > 0 &&
      // What can only be looked at is not dragged.
      editor.lock.value === null &&
      !editor.dragging.value &&
      !editor.notices.toast.value &&
      !editor.filling.wish.value &&
      !editor.layouts.isOpen.value &&
      editor.selected.value.length < 2 &&
      // Those who look for something else, or put somebody there, have found their way.
      placedBy(c) === null &&
      !searching.open.value &&
      !rounds.isOpen.value &&
      !variants.open.value &&
      !!editor.resting.value?.agents.size,
  );
  const place = useComputed(() => (shown.value ? placeOf(c) : '')).value;
  if (!shown.value) return null;
  return (
    <div class={`card coach ${ui.drawer.value ? 'shift' : ''} ${place}`}>
      {STEPS.map((text, i) => (
        <div key={i} class={`st ${ui.coach.value === i + 1 ? 'now' : ''}`}>
          <span class="n">{i + 1}</span>
          {text}
        </div>
      ))}
      <button type="button" class="btn i" aria-label={TEXTS.closeTheHint} onClick={() => ui.endCoach()}>
        <Icon name="x" size={16} />
      </button>
    </div>
  );
}

/** It speaks of the car and of its flag, and must not lie over them: elsewhere than usual where it would. */
function placeOf({ editor, form, stage: { view: v } }: Context): '' | 'above' | 'below' | 'left' | 'right' {
  void viewTick.value;
  const a = editor.agent.value;
  const [car, goal] = [a && poseShown(editor, a), a && editor.goalPose(a)].map((p) => p && v.to(p.x, p.y));
  const flag = goal && ([goal[0], goal[1] - FLAG_HEIGHT * v.grip] as const);
  const covers = (x0: number, x1: number, y0: number, y1: number): boolean =>
    [car, goal, flag].some((p) => !!p && p[0] > x0 && p[0] < x1 && p[1] > y0 && p[1] < y1);
  const mid = v.w / 2;
  if (!form.sheet.value) return covers(mid - HALF_WIDTH_PX, mid + HALF_WIDTH_PX, v.h - REACHES_PX, v.h) ? 'above' : '';
  if (form.small.value) return covers(0, v.w, 0, REACHES_PX) ? 'below' : '';
  const wide = 2 * HALF_STEP_PX;
  const starts = [
    ['', mid - HALF_STEP_PX],
    ['left', v.inset.left],
    ['right', v.w - wide],
  ] as const;
  return starts.find(([, x]) => !covers(x, x + wide, 0, REACHES_DOWN_PX))?.[0] ?? '';
}
