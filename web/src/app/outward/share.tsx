// A link with the whole scene inside: its contents, its size, and a copy button.
import { num } from '../../model/base/units';
import { useEffect } from 'preact/hooks';
import { useSignal } from '@preact/signals';
import type { SharedParts } from '../../edit/document/shared-parts';
import type { Link } from '../../edit/document/sharing';
import { MOST_LINK_BYTES } from '../../edit/document/share-link';
import type { SceneListItem, SceneShare } from '../../net/types';
import { download } from '../../edit/tools/outward/download';
import '../../styles/outward.css';
import { useApp } from '../parts/app-context';
import { Icon } from '../parts/icons';
import { Flyout } from './flyout';
import { TEXTS } from '../../texts/files/share';

const COPIED_MS = 1500;
const ALL: SharedParts = { futures: true, words: true, start: true };
const KB = 1024;

export default function Share() {
  const c = useApp();
  const { editor, sharing, stage } = c;
  const parts = useSignal<SharedParts>(ALL);
  const link = useSignal<Link | null>(null);
  const copied = useSignal(false);
  const time = editor.playhead.time.value;
  const item = c.scenes.list.value.find((s) => s.id === editor.resting.value?.id);
  useEffect(() => {
    let newest = true;
    void sharing.link(parts.value, { time, camera: stage.view.camera }).then((made) => {
      if (newest) link.value = made;
    });
    return () => {
      newest = false;
    };
  }, [parts.value, time]);

  const copy = async () => {
    const url = link.peek()?.url;
    if (!url) return;
    try {
      await navigator.clipboard.writeText(url);
      copied.value = true;
      setTimeout(() => (copied.value = false), COPIED_MS);
    } catch {
      // Without clipboard permission the text is selected for copying.
      document.querySelector<HTMLInputElement>('.share input')?.select();
    }
  };
  const set = (name: keyof SharedParts) => (on: boolean) => (parts.value = { ...parts.peek(), [name]: on });
  const { url, bytes } = link.value ?? { url: null, bytes: 0 };
  const tooLong = link.value !== null && url === null;
  return (
    <Flyout label={TEXTS.share} under="share" class="share">
      <div class="pad">
        {item?.shared ? <Access item={item} /> : null}
        <h2>{TEXTS.shareALink}</h2>
        <p>
          {TEXTS.theLinkHolds} <b>{TEXTS.makeACopy}</b>.
        </p>
        <div class="row">
          <label class="field">
            <Icon name="link" size={14} />
            <input
              type="text"
              readonly
              aria-label={TEXTS.link}
              value={url ?? (tooLong ? TEXTS.tooLargeForA : TEXTS.packing)}
              onFocus={(e) => e.currentTarget.select()}
            />
          </label>
          <button
            type="button"
            class={`btn pri ${url ? '' : 'off'}`}
            data-first=""
            aria-disabled={!url}
            onClick={() => void copy()}
          >
            <Icon name={copied.value ? 'check' : 'copy'} size={14} />
            {copied.value ? TEXTS.copied : TEXTS.copy}
          </button>
        </div>
        <div class="size">
          <div class={`bar ${tooLong ? 'over' : ''}`} aria-hidden="true">
            <i style={{ width: `${Math.min(100, (100 * bytes) / MOST_LINK_BYTES)}%` }} />
          </div>
          <span>{TEXTS.ofKb(Math.ceil(bytes / KB), MOST_LINK_BYTES / KB)}</span>
        </div>
        {tooLong ? (
          <p class="why">
            <b>{TEXTS.thisSceneIsToo}</b> {TEXTS.leaveAPartOut}
          </p>
        ) : null}
        <Switch label={TEXTS.chosenFuture} on={parts.value.futures} set={set('futures')} />
        <Switch label={TEXTS.nameAndNotes} on={parts.value.words} set={set('words')} />
        <Switch
          label={TEXTS.startPlayback(num(time, 1))}
          note={TEXTS.withTheView}
          on={parts.value.start}
          set={set('start')}
        />
        <Switch label={TEXTS.history} note={TEXTS.staysHereToo} on={false} />
      </div>
      <div class="dfoot">
        <span class="mut">{item?.shared ? TEXTS.whateverTheAccess : TEXTS.nothingUploaded}</span>
        <span class="grow" />
        <button type="button" class="btn line" onClick={() => void download(c, 'dragtraffic')}>
          {TEXTS.saveAsFile}
        </button>
      </div>
    </Flyout>
  );
}

const MAY: readonly SceneShare[] = ['nobody', 'read', 'edit'];

/** What others may do with the scene, on a server whose scenes have owners; only the owner changes it. */
function Access({ item }: { item: SceneListItem }) {
  const { care, ownership } = useApp();
  const foreign = ownership.foreign.value.has(item.id);
  return (
    <div class="access">
      <h2>
        {TEXTS.access}
        <small>{TEXTS.owner(item.owner!)}</small>
      </h2>
      <div class="seg" role="radiogroup" aria-label={TEXTS.access}>
        {MAY.map((may) => (
          <button
            key={may}
            type="button"
            role="radio"
            aria-checked={may === item.shared}
            aria-disabled={foreign}
            class={`btn ${may === item.shared ? 'on' : ''} ${foreign ? 'off' : ''}`}
            onClick={() => !foreign && void care.share(may)}
          >
            {TEXTS.mayOthers[may]}
          </button>
        ))}
      </div>
    </div>
  );
}

interface PartSwitchProps {
  label: string;
  note?: string;
  on: boolean;
  /** Absent where it is fixed. */
  set?: (on: boolean) => void;
}

function Switch({ label, note, on, set }: PartSwitchProps) {
  return (
    <button
      type="button"
      class={`switch ${set ? '' : 'off'}`}
      role="switch"
      aria-checked={on}
      aria-disabled={!set}
      onClick={() => set?.(!on)}
    >
      <span>
        {label}
        {note ? <small>{note}</small> : null}
      </span>
      <i class="knob" />
    </button>
  );
}
