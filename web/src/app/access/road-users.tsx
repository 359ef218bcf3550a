// The road users as a list, for those who do not see the canvas.
import { useMemo } from 'preact/hooks';
import { useComputed, type ReadonlySignal } from '@preact/signals';
import type { Context } from '../../actions/context';
import { canChange, hasGoal, startPose, type Agent } from '../../model/scene';
import { speedLabel } from '../../model/units';
import { laneWords } from '../../edit/snap';
import { useAgent } from '../inspector/use-agent';
import { useApp } from '../parts/app-context';

export function RoadUsers() {
  const { editor } = useApp();
  const id = useComputed(() => editor.scene.value?.id).value;
  const label = useComputed(() => `Road users, ${editor.scene.value?.agents.size ?? 0}`);
  return (
    <nav class="sr" aria-label={label} data-group="users">
      {id === undefined ? null : <List key={id} />}
    </nav>
  );
}

function List() {
  const { editor } = useApp();
  // Who comes or goes makes another list; who only changes does not.
  const roster = useComputed(() => editor.scene.value?.roster).value;
  const listed = useMemo(
    () => [...(editor.scene.peek()?.agents.values() ?? [])].filter(canChange).map((a) => a.id),
    [roster, editor],
  );
  /** The one that Tab comes to: who is selected, else the first. */
  const tabStop = useComputed(() => editor.selected.value[0] ?? editor.scene.value?.agents.keys().next().value);
  return (
    <ul>
      {listed.map((id) => (
        <li key={id}>
          <RoadUser id={id} tabStop={tabStop} />
        </li>
      ))}
    </ul>
  );
}

/** The buttons stay while events come and go, or the focus would fall off the page. */
function RoadUser({ id, tabStop }: { id: string; tabStop: ReadonlySignal<string | undefined> }) {
  const c = useApp();
  const { editor } = c;
  const agent = useAgent(id);
  const event = useComputed(
    () => editor.events.value.find((e) => !e.inLog && (e.a.id === id || e.b?.id === id))?.label ?? '',
  );
  const words = useComputed(() => wordsFor(c, agent.value, event.value));
  const pressed = useComputed(() => String(editor.selected.value.includes(id)));
  const tabindex = useComputed(() => (tabStop.value === id ? 0 : -1));
  return (
    <button
      type="button"
      data-agent={id}
      tabindex={tabindex}
      aria-pressed={pressed as never}
      onClick={(e) => {
        if (e.shiftKey) editor.toggleSelected(id);
        else editor.select(id);
        c.reveal([id]);
      }}
    >
      {words}
    </button>
  );
}

/** `Car 4, 16 km/h, westbound lane, goal set, near miss 4.7 s` */
function wordsFor({ editor }: Context, a: Agent, event: string): string {
  const p = startPose(a);
  if (!p) return a.name;
  const place = a.parked ? 'parked' : laneWords(editor.scene.peek()!.map, a, p.x, p.y, p.heading);
  const goal = hasGoal(a.goal) ? 'goal set' : '';
  return [a.name, speedLabel(p.speed, editor.unitOf(a)), place, goal, event.toLowerCase()].filter(Boolean).join(', ');
}
