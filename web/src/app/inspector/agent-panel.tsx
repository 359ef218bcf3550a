// The inspector of one road user: verdict on the goal, start, goal, six futures, reactions.
import type { ComponentChildren } from 'preact';
import { useRef } from 'preact/hooks';
import { useComputed } from '@preact/signals';
import { seenUntil } from '../../model/physics/playback';
import { canChange, changedByHand, hasGoal, startPose, type Agent } from '../../model/document/scene';
import { messageText } from '../../model/words/message-text';
import { seconds } from '../../model/base/units';
import { callIt } from '../../edit/moves/several';
import { laneWords } from '../../edit/moves/snap';
import { useApp } from '../parts/app-context';
import { ActionButton, IconButton } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { Changes } from './changes';
import { CurveSection } from './curve-section';
import { FuturesSection } from './futures-section';
import { Hint } from './hint';
import { GoalSection, StartSection } from './part-sections';
import { ViasSection } from './vias-section';
import { useAgent, type LiveAgent } from './use-agent';
import { verdictOn } from './verdict';
import { capitalised } from '../../texts/language';
import { TEXTS } from '../../texts/panels/agent';

// In one script with the panel: a selection needs both at once.
export { Sliders } from '../access/sliders';

export function AgentPanel({ id }: { id: string }) {
  const agent = useAgent(id);
  const first = agent.peek();
  return (
    <>
      <Head agent={agent} />
      {canChange(first) ? (
        <>
          <LockLine agent={agent} />
          <Fields agent={agent} class="verdict">
            <Hint agent={agent} />
            <Warnings agent={agent} />
          </Fields>
          <Changes />
          <FuturesSection agent={agent} />
          <Fields agent={agent}>
            <CurveSection agent={agent} />
            <GoalSection agent={agent} />
            <ViasSection agent={agent} />
            <StartSection agent={agent} />
          </Fields>
          <div class="grow" />
          <Foot agent={agent} />
        </>
      ) : (
        <div class="sect last">
          <p class="sec">{whyNot(first)}</p>
        </div>
      )}
    </>
  );
}

/** Time of the first recorded state. */
const appearsAt = (a: Agent): string => seconds((a.log.valid[0]?.[0] ?? 0) / 10);

const whyNot = (a: Agent): string => (a.type === 'other' ? TEXTS.objectsOfThis : TEXTS.onlyRoadUsers(appearsAt(a)));

function Head({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const kind = useComputed(() => agent.value.kind).value;
  const colour = useComputed(() => (agent.value.parked ? 'parked' : agent.value.type)).value;
  const where = useComputed(() => {
    const a = agent.value;
    const p = startPose(a);
    if (!p) return TEXTS.appearsAt(appearsAt(a));
    const place = a.parked ? TEXTS.parked : capitalised(laneWords(editor.scene.value!.map, a, p.x, p.y, p.heading));
    const until = seenUntil(editor.scene.value!, editor.answers.motion.value, a);
    const seen = until === null ? place : TEXTS.seenUntil(seconds(until), place);
    // If the name already has the id, the place gets the space.
    return a.name.endsWith(` ${a.id}`) ? seen : TEXTS.id(seen, a.id);
  });
  return (
    <div class="ih">
      <div class={`ag t-${colour}`}>
        <Icon name={kind} size={22} />
      </div>
      <div class="grow">
        <NameField agent={agent} />
        <p class="where" title={where}>
          {where}
        </p>
        <VerdictLine agent={agent} />
      </div>
      <IconButton id="menu" icon="more" />
    </div>
  );
}

/** The verdict in one line, for small spaces. */
function VerdictLine({ agent }: { agent: LiveAgent }) {
  const c = useApp();
  const v = useComputed(() => verdictOn(c, agent)).value;
  return v ? (
    <p class={`vline ${v.kind}`}>
      <Icon name={v.icon} size={14} />
      {v.title}
    </p>
  ) : null;
}

/** The name, editable in place; an empty one becomes kind and number again. */
function NameField({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const input = useRef<HTMLInputElement>(null);
  const name = useComputed(() => agent.value.name);
  const done = () => {
    if (!input.current) return;
    const typed = input.current.value.trim();
    if (typed !== name.peek()) editor.commits.run(callIt(agent.peek(), typed || null));
    input.current.value = name.peek();
  };
  return (
    <h2>
      <input
        ref={input}
        type="text"
        class="name"
        data-text="name"
        aria-label={TEXTS.nameOfTheRoad}
        maxlength={60}
        spellcheck={false}
        value={name}
        onBlur={done}
        onKeyDown={(e) => {
          if (e.key === 'Escape') input.current!.value = name.peek();
          if (e.key !== 'Enter' && e.key !== 'Escape') return;
          input.current!.blur();
          e.stopPropagation();
        }}
      />
      <span class="sr">{name}</span>
    </h2>
  );
}

/** Tells that it is locked, with the way out. */
function LockLine({ agent }: { agent: LiveAgent }) {
  const locked = useComputed(() => agent.value.locked).value;
  if (!locked) return null;
  return (
    <div class="sect lockline">
      <Icon name="lock" size={15} />
      <span class="grow">{TEXTS.lockedCannotBeChanged}</span>
      <ActionButton id="lock" class="line" icon="" size={15}>
        {TEXTS.unlock}
      </ActionButton>
    </div>
  );
}

interface FieldsProps {
  readonly agent: LiveAgent;
  readonly class?: string;
  readonly children: ComponentChildren;
}

/** Fields of a road user; those of a locked one are read-only. */
function Fields({ agent, class: className = '', children }: FieldsProps) {
  const locked = useComputed(() => agent.value.locked).value;
  return (
    <fieldset class={`fields ${className}`} disabled={locked}>
      {children}
    </fieldset>
  );
}

const OFF_ROAD: ReadonlySet<string> = new Set(['goal-off-road', 'start-off-road']);

function Warnings({ agent }: { agent: LiveAgent }) {
  const c = useApp();
  const list = useComputed(() => {
    const all = c.editor.answers.motion.value.warnings?.get(agent.value.id);
    // The verdict already reports the missing lane.
    return verdictOn(c, agent)?.snap ? all?.filter((w) => !OFF_ROAD.has(w.code)) : all;
  }).value;
  if (!list?.length) return null;
  return (
    <div class="sect">
      {list
        .map((w) => messageText(w))
        .map((w) => (
          <div key={w} class="hint plain">
            <Icon name="warn" size={17} />
            <div class="tx">{w}</div>
          </div>
        ))}
    </div>
  );
}

/** One button for the next step with the goal: set it, or take back what was changed. */
function Foot({ agent }: { agent: LiveAgent }) {
  const goal = useComputed(() => hasGoal(agent.value.goal)).value;
  const recorded = useComputed(() => changedByHand(agent.value) && !agent.value.placed).value;
  return (
    <div class="sect foot">
      {!goal ? (
        <ActionButton key="set" id="set-goal" class="goal" size={15} withKey />
      ) : recorded ? (
        <ActionButton key="reset" id="reset-agent" class="line" size={15} withKey />
      ) : (
        <ActionButton key="clear" id="clear-goal" class="line" size={15} withKey />
      )}
    </div>
  );
}
