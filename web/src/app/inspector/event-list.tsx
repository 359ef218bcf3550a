// What happens as a list, and the way to one of them.
import type { ComponentChild } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import { useComputed } from '@preact/signals';
import { goToEvent } from '../../actions/time';
import { closeInTime, counted } from '../../model/physics/events';
import type { TrafficEvent } from '../../model/words/event-words';
import { seconds } from '../../model/base/units';
import { useApp } from '../parts/app-context';
import { Icon } from '../parts/icons';
import { TEXTS } from '../../texts/panels/inspector';

/** `below` is what stands under the event that is picked. */
export function EventList({ most = Infinity, below }: { most?: number; below?: (e: TrafficEvent) => ComponentChild }) {
  const { editor, ui } = useApp();
  const all = editor.events.value;
  const own = counted(all);
  // Those that count come first.
  const events = [...own, ...all.filter((e) => e.inLog)].slice(0, most);
  const left = own.length - events.length;
  return (
    <div>
      {own.length ? null : <NoEvents />}
      {events.map((e) => (
        <Row key={`${e.what}:${e.a.id}:${e.b?.id ?? ''}:${e.time}`} event={e} below={below} />
      ))}
      {left > 0 ? (
        <button type="button" class="btn line" onClick={() => ui.showEvents(true)}>
          {TEXTS.moreEvents(left)}
        </button>
      ) : null}
    </div>
  );
}

function Row({ event: e, below }: { event: TrafficEvent; below?: (e: TrafficEvent) => ComponentChild }) {
  const c = useApp();
  const all = useRef<HTMLDivElement>(null);
  const picked = c.editor.selectedEvent.value === e;
  // It may be picked in the picture or by a key, far down a long list.
  useEffect(() => {
    if (picked) all.current?.scrollIntoView({ block: 'nearest' });
  }, [picked]);
  return (
    <div ref={all}>
      <button
        type="button"
        class={`evrow ${e.inLog ? 'log' : ''}`}
        aria-current={picked}
        title={`${e.title}: ${e.words}`}
        onClick={() => goToEvent(c, e)}
      >
        <span class={`mk ${e.kind}`}>
          <Icon name={`mark-${e.kind}`} size={15} />
        </span>
        <span class="who">
          <b>{e.title}</b>
          <small>{e.words}</small>
        </span>
        <span class="t">{seconds(e.time)}</span>
      </button>
      {picked ? below?.(e) : null}
    </div>
  );
}

function NoEvents() {
  const { editor } = useApp();
  const known = useComputed(() => editor.motion.value.score !== null).value;
  const away = useComputed(() => editor.away.value !== null).value;
  const nobody = useComputed(() => editor.resting.value?.agents.size === 0).value;
  const close = useComputed(() => closeInTime(editor.motion.value)).value;
  if (nobody) return <p class="sec">{TEXTS.nothingToJudge}</p>;
  const unknown = away ? TEXTS.notKnownWhile : TEXTS.notWorkedOut;
  const none = close === null ? TEXTS.noCollisions : TEXTS.noneButClose(seconds(close));
  return (
    <div class="kindrow">
      <span class={`dot ${!known ? 'busy' : close === null ? '' : 'near'}`} />
      <span class="sec">{known ? none : unknown}</span>
    </div>
  );
}
