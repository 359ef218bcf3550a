// A short notice of a result or a refusal, with an action to undo or continue.
import { useComputed } from '@preact/signals';
import { useApp } from '../parts/app-context';
import { KeyCaps } from '../parts/buttons';
import { coveredInHand } from './keep-clear';
import { TEXTS } from '../../texts/desk/hud';

/** Half the width of a usual notice, its height, and its distances from the lower and the upper edge. */
const HALF_WIDTH_PX = 240;
const HEIGHT_PX = 40;
const ABOVE_EDGE_PX = 56;
const BELOW_EDGE_PX = 12;
/** The panels' edge is this far below the clear part of the picture. */
const EDGE_PX = 56;

export function Toast() {
  const c = useApp();
  const { editor, ui, stage } = c;
  // It lies where it covers less of what was just dragged.
  const high = useComputed(() => {
    const { w, h, inset } = stage.view;
    const mid = w / 2 + (ui.drawer.value ? inset.left / 2 : 0);
    const covered = coveredInHand(c);
    const at = (top: number): number => covered(mid - HALF_WIDTH_PX, mid + HALF_WIDTH_PX, top, top + HEIGHT_PX);
    return at(BELOW_EDGE_PX) < at(h - inset.bottom + EDGE_PX - ABOVE_EDGE_PX - HEIGHT_PX);
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
