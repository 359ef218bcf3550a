// Collisions and near misses as a list, and the way to one of them.
import { useComputed } from '@preact/signals';
import type { Context } from '../../actions/context';
import type { TrafficEvent } from '../../model/events';
import { seconds } from '../../model/units';
import { useApp } from '../parts/app-context';

/** An event nearer to the edge of the picture than this is brought to the middle, in pixels. */
const EDGE_PX = 60;

export function goToEvent(c: Context, e: TrafficEvent): void {
  const { editor, stage, ui } = c;
  editor.playhead.pause();
  editor.setTime(e.time);
  editor.pickEvent(e);
  ui.showEvents(true);
  const v = stage.view;
  const [x, y] = v.to(e.at[0], e.at[1]);
  const inView = x >= v.inset.left + EDGE_PX && x <= v.w - EDGE_PX && y >= EDGE_PX && y <= v.h - EDGE_PX;
  if (inView) return;
  v.centre(e.at[0], e.at[1]);
  stage.viewChanged();
}

export function EventList({ most = Infinity }: { most?: number }) {
  const c = useApp();
  const { editor } = c;
  const events = editor.events.value.slice(0, most);
  if (!events.length) return <NoEvents />;
  return (
    <div>
      {events.map((e) => (
        <button
          key={`${e.kind}:${e.a.id}:${e.b.id}:${e.time}`}
          type="button"
          class="evrow"
          aria-current={editor.selectedEvent.value === e}
          onClick={() => goToEvent(c, e)}
        >
          <span class={`tag ${e.kind}`}>{e.kind === 'collision' ? 'Collision' : 'Near miss'}</span>
          <b>{e.title}</b>
          <span class="t">{seconds(e.time)}</span>
        </button>
      ))}
    </div>
  );
}

function NoEvents() {
  const { editor } = useApp();
  const known = useComputed(() => editor.motion.value.score !== null).value;
  const away = useComputed(() => editor.away.value !== null).value;
  const unknown = away ? 'Not known while the generator is away' : 'Not worked out yet';
  return (
    <div class="kindrow">
      <span class={`dot ${known ? '' : 'busy'}`} />
      <span class="sec">{known ? 'No collisions, no near misses' : unknown}</span>
    </div>
  );
}
