// The hint of the first minute, and the toast.
import { useApp } from '../parts/app-context';
import { useComputed } from '@preact/signals';
import { KeyCaps } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { TEXTS } from '../../texts/hud';

const STEPS = [TEXTS.clickACar, TEXTS.dragItsFlagTo, TEXTS.letGoTheOthers];

export function Coach() {
  const { editor, form, rounds, searching, ui, variants } = useApp();
  const shown = useComputed(
    () =>
      ui.coach.value > 0 &&
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
  if (!shown.value) return null;
  return (
    <div class={`card coach ${ui.drawer.value ? 'shift' : ''}`}>
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
      ) : (
        [action, second].map((a) =>
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
        )
      )}
    </div>
  );
}
