// The list of road users: always present for screen readers, and a panel with filters for all users.
import { useEffect, useMemo } from 'preact/hooks';
import { useComputed, useSignal, type ReadonlySignal } from '@preact/signals';
import type { Context } from '../../actions/context';
import { canChange, hasGoal, startPose, type Agent } from '../../model/document/scene';
import type { AgentType } from '../../model/base/kinds';
import { speedLabel } from '../../model/base/units';
import { laneWords } from '../../edit/moves/snap';
import { useAgent } from '../inspector/use-agent';
import { useApp } from '../parts/app-context';
import { DrawerTabs } from '../parts/drawer-tabs';
import { Icon } from '../parts/icons';
import { TEXTS } from '../../texts/desk/access';
import { inSentence } from '../../texts/language';

const KINDS: readonly (readonly [AgentType | 'all', string])[] = [
  ['all', TEXTS.all],
  ['vehicle', TEXTS.vehicles],
  ['cyclist', TEXTS.cyclists],
  ['pedestrian', TEXTS.onFoot],
];

/** Filter of the list: kind, and optionally only road users with a goal, or in an event. */
interface UserFilter {
  readonly kind: AgentType | 'all';
  readonly goal: boolean;
  readonly events: boolean;
}
const EVERYBODY: UserFilter = { kind: 'all', goal: false, events: false };

export function RoadUsers() {
  const { editor, ui } = useApp();
  const id = useComputed(() => editor.resting.value?.id).value;
  const label = useComputed(() => TEXTS.roadUsers(editor.resting.value?.agents.size ?? 0));
  const open = useComputed(() => ui.drawer.value === 'users').value;
  const filter = useSignal(EVERYBODY);
  // A closed list has no visible filters, so it contains all.
  useEffect(() => {
    if (!open) filter.value = EVERYBODY;
  }, [open, filter]);
  return (
    <nav
      class={open ? 'drawer card users' : 'sr'}
      aria-label={label}
      aria-description={open ? TEXTS.useTheArrowKeys : TEXTS.tabGoesToThe}
      data-group="users"
      onKeyDown={open ? walkList : undefined}
    >
      {open ? <Head filter={filter} /> : null}
      {id === undefined ? null : <List key={id} filter={filter} />}
    </nav>
  );
}

/** In the open list the arrow keys walk the list instead of moving the selection. */
function walkList(e: KeyboardEvent & { currentTarget: HTMLElement }): void {
  if (e.key !== 'ArrowDown' && e.key !== 'ArrowUp') return;
  const all = [...e.currentTarget.querySelectorAll<HTMLElement>('[data-agent]')];
  const at = all.indexOf(e.target as HTMLElement);
  if (at < 0) return;
  e.preventDefault();
  e.stopPropagation();
  all[at + (e.key === 'ArrowDown' ? 1 : -1)]?.focus();
}

function Head({ filter }: { filter: { value: UserFilter } }) {
  const { kind, goal, events } = filter.value;
  const toggle = (what: 'goal' | 'events', words: string, on: boolean) => (
    <button
      type="button"
      class={`btn line ${on ? 'on' : ''}`}
      aria-pressed={on}
      onClick={() => (filter.value = { ...filter.value, [what]: !on })}
    >
      {on ? <Icon name="check" size={14} /> : null}
      {words}
    </button>
  );
  return (
    <>
      <DrawerTabs />
      <div class="filters" role="group" aria-label={TEXTS.filters}>
        <div class="seg wide" role="radiogroup" aria-label={TEXTS.type}>
          {KINDS.map(([id, words]) => (
            <button
              key={id}
              type="button"
              class={`btn ${kind === id ? 'on' : ''}`}
              role="radio"
              aria-checked={kind === id}
              onClick={() => (filter.value = { ...filter.value, kind: id })}
            >
              {words}
            </button>
          ))}
        </div>
        {toggle('goal', TEXTS.withAGoal, goal)}
        {toggle('events', TEXTS.inAnEvent, events)}
      </div>
    </>
  );
}

const inEvent = ({ editor }: Context, id: string) =>
  editor.reading.events.value.find((e) => !e.inLog && (e.a.id === id || e.b?.id === id));

function List({ filter }: { filter: ReadonlySignal<UserFilter> }) {
  const c = useApp();
  const { editor } = c;
  // Added or removed road users change the list; changed ones do not.
  const castKey = useComputed(() => editor.resting.value?.castKey).value;
  const everybody = useMemo(
    () => [...(editor.scene.peek()?.agents.values() ?? [])].filter(canChange).map((a) => a.id),
    [castKey, editor],
  );
  const listed = useComputed(() => {
    const { kind, goal, events } = filter.value;
    const fits = (a: Agent | undefined): boolean =>
      a !== undefined &&
      (kind === 'all' || a.type === kind) &&
      (!goal || hasGoal(a.goal)) &&
      (!events || !!inEvent(c, a.id));
    if (filter.value === EVERYBODY) return '';
    return everybody.filter((id) => fits(editor.resting.value?.agents.get(id))).join('\n');
  }).value;
  const shown = filter.value === EVERYBODY ? everybody : listed.split('\n').filter(Boolean);
  /** The Tab stop: the selected road user, else the first. */
  const tabStop = useComputed(() => editor.selected.value[0] ?? editor.resting.value?.agents.keys().next().value);
  return (
    <>
      {shown.length ? null : <p class="mut none">{TEXTS.noMatches}</p>}
      <ul>
        {shown.map((id) => (
          <li key={id}>
            <RoadUser id={id} tabStop={tabStop} />
          </li>
        ))}
      </ul>
    </>
  );
}

/** The buttons persist when events change, or the focus would be lost. */
function RoadUser({ id, tabStop }: { id: string; tabStop: ReadonlySignal<string | undefined> }) {
  const c = useApp();
  const { editor } = c;
  const chosen = useComputed(() => editor.selected.value.includes(id));
  // During a drag the other rows are unchanged, so they do not follow the preview.
  const agent = useAgent(id, () => (chosen.value ? editor.scene : editor.resting));
  const event = useComputed(() => inEvent(c, id)?.label ?? '');
  const name = useComputed(() => agent.value.name);
  const words = useComputed(() => `, ${wordsFor(c, agent.value, event.value)}`);
  const pressed = useComputed(() => String(chosen.value));
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
      <b>{name}</b>
      <small>{words}</small>
    </button>
  );
}

/** `16 km/h, westbound lane, goal set, near miss 4.7 s` */
function wordsFor({ editor }: Context, a: Agent, event: string): string {
  const p = startPose(a);
  if (!p) return TEXTS.appearsLater;
  const place = a.parked ? TEXTS.parked : laneWords(editor.scene.peek()!.map, a, p.x, p.y, p.heading);
  const goal = hasGoal(a.goal) ? TEXTS.goalSet : '';
  return [speedLabel(p.speed, editor.view.unitOf(a)), place, goal, inSentence(event)].filter(Boolean).join(', ');
}
