// A link with the whole scene inside: what goes into it, how much that is, and the copy of it.
import { useEffect } from 'preact/hooks';
import { useSignal } from '@preact/signals';
import type { Link, Parts } from '../../edit/sharing';
import { MOST_LINK_BYTES } from '../../edit/share-link';
import { download } from '../../edit/download';
import '../../styles/outward.css';
import { useApp } from '../parts/app-context';
import { Icon } from '../parts/icons';
import { Flyout } from './flyout';

const COPIED_MS = 1500;
const ALL: Parts = { futures: true, words: true, start: true };
const KB = 1024;

export default function Share() {
  const c = useApp();
  const { editor, sharing, stage } = c;
  const parts = useSignal<Parts>(ALL);
  const link = useSignal<Link | null>(null);
  const copied = useSignal(false);
  const { cx, cy, z } = stage.view;
  const time = editor.time.value;
  useEffect(() => {
    let newest = true;
    void sharing.link(parts.value, { time, camera: { cx, cy, z } }).then((made) => {
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
      // Without the right to the clipboard the text is there to be copied by hand.
      document.querySelector<HTMLInputElement>('.share input')?.select();
    }
  };
  const set = (name: keyof Parts) => (on: boolean) => (parts.value = { ...parts.peek(), [name]: on });
  const { url, bytes } = link.value ?? { url: null, bytes: 0 };
  const tooLong = link.value !== null && url === null;
  return (
    <Flyout label="Share" under="share" class="share">
      <div class="pad">
        <h2>Share a link</h2>
        <p>
          The link holds the whole scene and opens read-only. Whoever gets it can <b>Make a copy</b>.
        </p>
        <div class="row">
          <label class="field">
            <Icon name="link" size={14} />
            <input
              type="text"
              readonly
              aria-label="Link"
              value={url ?? (tooLong ? 'Too large for a link' : 'Packing …')}
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
            {copied.value ? 'Copied' : 'Copy'}
          </button>
        </div>
        <div class="size">
          <div class={`bar ${tooLong ? 'over' : ''}`} aria-hidden="true">
            <i style={{ width: `${Math.min(100, (100 * bytes) / MOST_LINK_BYTES)}%` }} />
          </div>
          <span>
            {Math.ceil(bytes / KB)} of {MOST_LINK_BYTES / KB} KB
          </span>
        </div>
        {tooLong ? (
          <p class="why">
            <b>This scene is too large for a link.</b> Leave a part out, or save it as a file and send that.
          </p>
        ) : null}
        <Switch label="Chosen future and goals" on={parts.value.futures} set={set('futures')} />
        <Switch label="Name and notes" on={parts.value.words} set={set('words')} />
        <Switch
          label={`Start the film at ${time.toFixed(1)} s`}
          note="with what is in view now"
          on={parts.value.start}
          set={set('start')}
        />
        <Switch label="History" note="stays here: too large for a link" on={false} />
      </div>
      <div class="dfoot">
        <span class="mut">No account, nothing is uploaded.</span>
        <span class="grow" />
        <button type="button" class="btn line" onClick={() => void download(c, 'dragtraffic')}>
          Save as file
        </button>
      </div>
    </Flyout>
  );
}

interface SwitchProps {
  label: string;
  note?: string;
  on: boolean;
  /** Absent where it cannot be changed. */
  set?: (on: boolean) => void;
}

function Switch({ label, note, on, set }: SwitchProps) {
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
      <i />
    </button>
  );
}
