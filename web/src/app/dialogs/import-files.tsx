// File kinds for import, and how to import each.
import { useEffect } from 'preact/hooks';
import { useSignal } from '@preact/signals';
import { inKinds } from '../../edit/tools/outward/formats';
import type { FormatInfo } from '../../net/types';
import { useApp } from '../parts/app-context';
import { ActionButton } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { Modal } from '../parts/modal';
import { TEXTS } from '../../texts/files/imports';

export function ImportFiles() {
  const c = useApp();
  const formats = useSignal<readonly FormatInfo[] | null>(null);
  const away = useSignal(false);
  useEffect(() => {
    void c.client.formats().then(
      (f) => (formats.value = f),
      () => (away.value = true),
    );
  }, []);
  const close = () => c.ui.closeDialog();
  const choose = () => {
    close();
    c.chooseFiles();
  };
  return (
    <Modal label={TEXTS.importFiles} class="import bring" close={close}>
      <div class="dhead">
        <h2>{TEXTS.importAScene}</h2>
        <span class="grow" />
        <button type="button" class="btn i" aria-label={TEXTS.close} onClick={close}>
          <Icon name="x" size={16} />
        </button>
      </div>
      <div class="body">
        <div class="drop">
          <b>{TEXTS.dropFilesHere}</b>
          {TEXTS.severalAtOnce}
          <div class="ways">
            <button type="button" class="btn pri" data-first="" onClick={choose}>
              {TEXTS.chooseFiles}
            </button>
          </div>
        </div>
        {away.value ? (
          <p class="mut">{TEXTS.theServerIsNot}</p>
        ) : (
          <ul class="inkinds" aria-label={TEXTS.supportedFormats} aria-busy={formats.value === null}>
            {inKinds(formats.value ?? []).map((k) => (
              <li key={k.label}>
                <Icon name={k.icon} size={18} />
                <div>
                  <b>{k.label}</b>
                  <p>{k.says}</p>
                  <p class="ends">
                    {k.files.map((f) => (
                      <span key={f.id} title={f.name}>
                        {short(f.name)} <small>.{f.extensions[0]}</small>
                      </span>
                    ))}
                  </p>
                </div>
              </li>
            ))}
          </ul>
        )}
      </div>
      <div class="dfoot">
        <span class="mut">{TEXTS.gzipToo}</span>
        <span class="grow" />
        <ActionButton id="choose-part" icon="" class="line" />
      </div>
    </Modal>
  );
}

/** Without the parenthesised part, which repeats the endings. */
const short = (name: string): string => name.replace(/ \(.*\)$/, '');
