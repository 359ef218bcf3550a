// A copy under a name of one's own.
import { useRef } from 'preact/hooks';
import { useApp } from '../parts/app-context';
import { Modal } from '../parts/modal';
import { TEXTS } from '../../texts/files/save-as';

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
    <Modal label={TEXTS.saveAs} class="import narrow" close={close}>
      <div class="dhead">
        <h2>{TEXTS.saveAs}</h2>
      </div>
      <div class="body">
        <label class="field">
          <input
            ref={input}
            type="text"
            aria-label={TEXTS.name}
            data-first=""
            maxlength={80}
            value={editor.scene.peek()?.name ?? ''}
            onFocus={() => input.current!.select()}
            onKeyDown={(e) => {
              if (e.key === 'Enter') save();
            }}
          />
        </label>
        <p class="mut">{TEXTS.aSceneOfYour}</p>
      </div>
      <div class="dfoot">
        <span class="grow" />
        <button type="button" class="btn line" onClick={close}>
          {TEXTS.cancel}
        </button>
        <button type="button" class="btn pri" onClick={save}>
          {TEXTS.save}
        </button>
      </div>
    </Modal>
  );
}
