// A copy under a name of one's own.
import { useRef } from 'preact/hooks';
import { useApp } from '../parts/app-context';
import { Modal } from '../parts/modal';

export function SaveAs() {
  const { care, editor, ui } = useApp();
  const input = useRef<HTMLInputElement>(null);
  const close = () => ui.closeDialog();
  const save = () => {
    const name = input.current!.value.trim();
    if (!name) return;
    close();
    void care.saveAs(name);
  };
  return (
    <Modal label="Save as" class="import narrow" close={close}>
      <div class="dhead">
        <h2>Save as</h2>
      </div>
      <div class="body">
        <label class="field">
          <input
            ref={input}
            type="text"
            aria-label="Name"
            data-first=""
            maxlength={80}
            value={editor.scene.peek()?.name ?? ''}
            onFocus={() => input.current!.select()}
            onKeyDown={(e) => {
              if (e.key === 'Enter') save();
            }}
          />
        </label>
        <p class="mut">A scene of your own, which saves itself. This one stays as it is.</p>
      </div>
      <div class="dfoot">
        <span class="grow" />
        <button type="button" class="btn line" onClick={close}>
          Cancel
        </button>
        <button type="button" class="btn pri" onClick={save}>
          Save
        </button>
      </div>
    </Modal>
  );
}
