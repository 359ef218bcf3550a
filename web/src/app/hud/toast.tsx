// A short notice of a result or a refusal, with an action to undo or continue.
import { useComputed } from '@preact/signals';
import { useApp } from '../parts/app-context';
import { KeyCaps } from '../parts/buttons';
import { coversHand } from './keep-clear';
import { TEXTS } from '../../texts/desk/hud';

/** Room of the notice at the lower edge: half its width, and how far it reaches up. */
const HALF_WIDTH_PX = 270;
const REACHES_PX = 130;
/** The panels' edge is this far below the clear part of the picture. */
const EDGE_PX = 56;

export function Toast() {
  const c = useApp();
  const { editor, ui, stage } = c;
  // It never lies on what was just dragged.
  const high = useComputed(() => {
    const { w, h, inset } = stage.view;
    const mid = w / 2 + (ui.drawer.value ? inset.left / 2 : 0);
    const bottom = h - inset.bottom + EDGE_PX;
    return coversHand(c)(mid - HALF_WIDTH_PX, mid + HALF_WIDTH_PX, bottom - REACHES_PX, bottom);
  }).value;
  const { notices } = editor;
  const toast = notices.toast.value;
  if (!toast) return null;
  const { text, undo, action, second } = toast;
  return (
    <div class={`toast ${undo || action ? '' : 'plain'} ${ui.drawer.value ? 'shift' : ''} ${high ? 'high' : ''}`}>
      <span>{text}</span>
      {undo ? (
        <button type="button" class="btn" data-action="undo" onClick={() => editor.commits.undo()}>
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
