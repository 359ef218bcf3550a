// How near the selected ones come to each other, in space and in time.
import { useComputed, type ReadonlySignal } from '@preact/signals';
import { closestOf, timeGapOf, type Closest } from '../../model/physics/proximity';
import type { TrafficEvent } from '../../model/words/event-words';
import type { Agent } from '../../model/document/scene';
import { metres, seconds } from '../../model/base/units';
import { useApp } from '../parts/app-context';
import { TEXTS } from '../../texts/panels/several-panel';

/** Nearer than this they touch, metres. */
const TOUCH_M = 0.005;

/** How near they come: in space the two that come closest, and of two alone in time as well. */
export function Nearest({ those }: { those: ReadonlySignal<readonly Agent[]> }) {
  const { editor } = useApp();
  const moving = useComputed(() => {
    const scene = editor.scene.value;
    if (!scene || editor.dragging.value || editor.motion.value.stale) return null;
    return { all: those.value.map((a) => [a, editor.motionFor(a)] as const), duration: scene.duration };
  });
  const closest = useComputed(() => {
    const c = moving.value && closestOf(moving.value.all, moving.value.duration);
    // Of those who touch the event knows when, between two steps.
    const hits = (e: TrafficEvent): boolean =>
      e.kind === 'collision' && [e.a, e.b].every((x) => x === c?.a || x === c?.b);
    const hit = c && c.gap <= TOUCH_M ? editor.shownEvents.value.find(hits) : undefined;
    return c && hit ? { ...c, time: hit.time } : c;
  }).value;
  const between = useComputed(() => {
    const { all, duration } = moving.value ?? { all: [], duration: 0 };
    return all.length === 2 ? timeGapOf(all[0], all[1], duration) : null;
  }).value;
  return (
    <>
      {closest ? <Moment time={closest.time} title={TEXTS.goThere} words={closestWords(closest)} /> : null}
      {between ? (
        <Moment
          time={between.time}
          title={TEXTS.timeGapIs}
          words={TEXTS.timeGap(seconds(between.gap), between.first.name, between.second.name)}
        />
      ) : null}
    </>
  );
}

const closestWords = ({ a, b, gap }: Closest): string =>
  gap > TOUCH_M ? TEXTS.andGap(a.name, b.name, metres(gap, 1)) : TEXTS.andTheyTouch(a.name, b.name);

/** What happens at a moment; a click goes there. */
function Moment({ time, title, words }: { time: number; title: string; words: string }) {
  const { editor } = useApp();
  return (
    <button
      type="button"
      class="closest"
      title={title}
      onClick={() => {
        editor.playhead.pause();
        editor.setTime(time);
      }}
    >
      <span class="grow">{words}</span>
      <span class="mut">{TEXTS.at(seconds(time))}</span>
    </button>
  );
}
