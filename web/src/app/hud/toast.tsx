// What was done or cannot be done, for a few seconds, with a way back or on.
import { useApp } from '../parts/app-context';
import { KeyCaps } from '../parts/buttons';
import { TEXTS } from '../../texts/desk/hud';

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
