// The hint of the first minute.
import type { Context } from '../../actions/context';
import { placedBy } from '../../actions/place';
import { useApp } from '../parts/app-context';
import { useComputed } from '@preact/signals';
import { Icon } from '../parts/icons';
import { coveredInHand } from './keep-clear';
import { TEXTS } from '../../texts/desk/hud';

const STEPS = [TEXTS.clickACar, TEXTS.dragItsFlagTo, TEXTS.releaseToReact];
/** Half width of the hint with all steps and with one, and its extent from its edge, up and down. */
const HALF_WIDTH_PX = 340;
const HALF_STEP_PX = 200;
const REACHES_PX = 120;
const REACHES_DOWN_PX = 150;

export function Coach() {
  const c = useApp();
  const { editor, rounds, searching, ui, variants, filling, layouts } = c;
  const shown = useComputed(
    () =>
      ui.coach.value > 0 &&
      // A read-only scene has no drag.
      editor.document.lock.value === null &&
      !editor.drag.active.value &&
      !editor.reading.live.isOn.value &&
      !editor.notices.toast.value &&
      !filling.wish.value &&
      !layouts.isOpen.value &&
      editor.selected.value.length < 2 &&
      // Users who search or place something do not need the hint any more.
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

/** The hint is about the car and its flag, and must not cover them: it moves elsewhere where it would. */
function placeOf(c: Context): '' | 'above' | 'below' | 'left' | 'right' {
  const {
    form,
    stage: { view: v },
  } = c;
  const covered = coveredInHand(c);
  const covers = (...card: Parameters<typeof covered>): boolean => covered(...card) > 0;
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
