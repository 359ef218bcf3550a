// The palette: all actions, searched by name.
import { useRef } from 'preact/hooks';
import { useSignal, useComputed, type ReadonlySignal } from '@preact/signals';
import { useApp } from '../parts/app-context';
import { KeyCaps } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { Modal } from '../parts/modal';
import { find, type FindEntry } from './find';
import { TEXTS } from '../../texts/desk/palette';

export function Palette() {
  const c = useApp();
  const query = useSignal('');
  const at = useSignal(0);
  const input = useRef<HTMLInputElement>(null);
  const entries = find(c, query.value);
  const close = () => c.ui.closeDialog();
  const go = (e: FindEntry | undefined) => {
    if (!e || e.off) return;
    close();
    e.run();
  };
  const move = (step: 1 | -1) => {
    at.value = (at.peek() + step + entries.length) % Math.max(1, entries.length);
    document.querySelector(`[data-at="${at.peek()}"]`)?.scrollIntoView({ block: 'nearest' });
  };
  const keyDown = (e: KeyboardEvent) => {
    if (e.key === 'ArrowDown' || e.key === 'ArrowUp') move(e.key === 'ArrowDown' ? 1 : -1);
    else if (e.key === 'Enter') go(entries[at.peek()]);
    else return;
    e.preventDefault();
  };
  return (
    <Modal label={TEXTS.actions} class="pal" close={close}>
      <div class="in">
        <Icon name="search" />
        <input
          ref={input}
          type="text"
          placeholder={TEXTS.placeholder}
          aria-label={TEXTS.findAnAction}
          data-first=""
          spellcheck={false}
          role="combobox"
          aria-expanded="true"
          onInput={() => {
            query.value = input.current!.value;
            at.value = 0;
          }}
          onKeyDown={keyDown}
        />
        <kbd>{TEXTS.esc}</kbd>
      </div>
      <div class="list">
        <Results entries={entries} query={query.value} at={at} point={(i) => (at.value = i)} go={go} />
      </div>
      <Foot />
    </Modal>
  );
}

interface ResultsProps {
  entries: readonly FindEntry[];
  query: string;
  at: ReadonlySignal<number>;
  point: (index: number) => void;
  go: (e: FindEntry) => void;
}

function Results({ entries, query, at, point, go }: ResultsProps) {
  return (
    <div role="listbox" aria-label={TEXTS.actions}>
      {entries.length ? null : <div class="g">{TEXTS.noMatches}</div>}
      {entries.flatMap((e, i) => [
        e.group === entries[i - 1]?.group ? null : (
          <div key={`${i}:${e.group}`} class="g">
            {e.group}
          </div>
        ),
        <Result key={`${e.group}:${e.label}:${i}`} entry={e} query={query} index={i} at={at} point={point} go={go} />,
      ])}
    </div>
  );
}

type ResultProps = Omit<ResultsProps, 'entries'> & { entry: FindEntry; index: number };

function Result({ entry: e, query, index, at, point, go }: ResultProps) {
  const selected = useComputed(() => String(at.value === index));
  return (
    <button
      type="button"
      class={`it ${e.off ? 'off' : ''}`}
      role="option"
      tabindex={-1}
      data-at={index}
      aria-selected={selected as never}
      onClick={() => go(e)}
      onPointerMove={() => point(index)}
    >
      <Icon name={e.icon} />
      <span class="lb">
        <Marked text={e.label} query={query} />
      </span>
      <small>{e.note}</small>
      <span class="k">{e.keys[0] ? <KeyCaps of={e.keys[0]} /> : null}</span>
    </button>
  );
}

/** A text with the search words highlighted. */
function Marked({ text, query }: { text: string; query: string }) {
  const at = query ? text.toLowerCase().indexOf(query.toLowerCase()) : -1;
  if (at < 0) return <>{text}</>;
  const end = at + query.length;
  return (
    <>
      {text.slice(0, at)}
      <mark>{text.slice(at, end)}</mark>
      {text.slice(end)}
    </>
  );
}

function Foot() {
  return (
    <div class="ft">
      <span>
        <kbd>↑</kbd>
        <kbd>↓</kbd>
        {TEXTS.choose}
      </span>
      <span>
        <kbd>↵</kbd>
        {TEXTS.run}
      </span>
      <span>{TEXTS.typeANumberTo}</span>
    </div>
  );
}
