// The hint of the first minute, and the toast.
import { poseShown } from '../../edit/frame';
import { useApp } from '../parts/app-context';
import { useComputed } from '@preact/signals';
import { KeyCaps } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { viewTick } from './view-tick';
import { TEXTS } from '../../texts/hud';

const STEPS = [TEXTS.clickACar, TEXTS.dragItsFlagTo, TEXTS.letGoTheOthers];
/** How far the hint reaches to both sides of the middle, and up from the lower edge, with some air, in pixels. */
const HALF_WIDTH_PX = 340;
const REACHES_UP_PX = 120;

export function Coach() {
  const { editor, form, rounds, searching, stage, ui, variants } = useApp();
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
      // Those who look for something else have found their way.
      !searching.open.value &&
      !rounds.isOpen.value &&
      !variants.open.value &&
      editor.resting.value !== null,
  );
  // It speaks of the car and of its flag, and must not lie over them.
  const above = useComputed(() => {
    void viewTick.value;
    const a = shown.value && !form.sheet.value ? editor.agent.value : null;
    const { view: v } = stage;
    return [a && poseShown(editor, a), a && editor.goalPose(a)].some((p) => {
      if (!p) return false;
      const [x, y] = v.to(p.x, p.y);
      return y > v.h - REACHES_UP_PX && Math.abs(x - v.w / 2) < HALF_WIDTH_PX;
    });
  });
  if (!shown.value) return null;
  return (
    <div class={`card coach ${ui.drawer.value ? 'shift' : ''} ${above.value ? 'above' : ''}`}>
      {STEPS.map((text, i) => (
        <div key={i} class={`st ${ui.coach.value === i + 1 ? 'now' : ''}`}>
          <span class="n">{i + 1}</span>
          {i === 0 && form.touch.value ? TEXTS.tapACar : text}
        </div>
      ))}
      <button type="button" class="btn i" aria-label={TEXTS.closeTheHint} onClick={() => ui.endCoach()}>
        <Icon name="x" size={16} />
      </button>
    </div>
  );
}

export function Toast() {
  const { editor, ui } = useApp();
  const { notices } = editor;
  const toast = notices.toast.value;
  if (!toast) return null;
  const { text, undo, action, second } = toast;
  return (
    <div class={`toast ${undo || action ? '' : 'plain'} ${ui.drawer.value ? 'shift' : ''}`}>
      <span>{text}</span>
      {undo ? (
        <button type="button" class="btn" data-action="undo" onClick={() => editor.undo()}>
          {TEXTS.undo}
          <KeyCaps of="Ctrl+Z" />
        </button>
      ) : null}
      {[action, second].map((a) =>
        a ? (
          <button
            key={a.label}
            type="button"
            class="btn"
            onClick={() => {
              notices.hide();
              a.run();
            }}
          >
            {a.label}
          </button>
        ) : null,
      )}
    </div>
  );
}
