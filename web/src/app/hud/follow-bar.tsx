// While a run is followed that somebody else steps: who is driven, and its time.
import { useComputed } from '@preact/signals';
import { num } from '../../model/base/units';
import type { FollowedRun } from '../../edit/tools/following/followed-run';
import { useApp } from '../parts/app-context';
import { TEXTS } from '../../texts/editing/following';

export function FollowBar() {
  const run = useApp().following.run.value;
  return run ? <Bar followed={run} /> : null;
}

function Bar({ followed }: { readonly followed: FollowedRun }) {
  const { editor } = useApp();
  const words = useComputed(() => {
    const time = num(followed.time.value, 1);
    if (followed.ended.value) return TEXTS.hasEnded(time);
    const agents = editor.resting.value?.agents;
    return TEXTS.secondsOf(followed.egos.value.map((id) => agents?.get(id)?.name ?? id).join(', '), time);
  });
  return (
    <div class="card drivebar" role="group" aria-label={TEXTS.followed}>
      <b>{words}</b>
    </div>
  );
}
