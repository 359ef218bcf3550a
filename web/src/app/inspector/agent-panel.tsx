// The inspector of one road user: verdict on the goal, start, goal, six futures, who changed.
import { useComputed } from '@preact/signals';
import { canChange, changedByHand, hasGoal, startPose, type Agent } from '../../model/scene';
import { seconds } from '../../model/units';
import { laneWords } from '../../edit/snap';
import { useApp } from '../parts/app-context';
import { ActionButton, IconButton } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { Changes } from './changes';
import { FuturesSection } from './futures-section';
import { Hint } from './hint';
import { GoalSection, StartSection } from './part-sections';
import { useAgent, type LiveAgent } from './use-agent';
import { verdictOn } from './verdict';

export function AgentPanel({ id }: { id: string }) {
  const agent = useAgent(id);
  const first = agent.peek();
  return (
    <>
      <Head agent={agent} />
      {canChange(first) ? (
        <>
          <Hint agent={agent} />
          <Warnings agent={agent} />
          <StartSection agent={agent} />
          <GoalSection agent={agent} />
          <FuturesSection agent={agent} />
          <Changes />
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

/** When a road user is first seen in the log. */
const appearsAt = (a: Agent): string => seconds((a.log.valid[0]?.[0] ?? 0) / 10);

const whyNot = (a: Agent): string =>
  a.type === 'other'
    ? 'Objects of this kind are shown but not changed.'
    : `Only road users that are there at 0.0 s can be changed. This one appears at ${appearsAt(a)}.`;

const sentenceCase = (s: string): string => s.charAt(0).toUpperCase() + s.slice(1);

function Head({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const { parked, type, kind, name } = agent.peek();
  const where = useComputed(() => {
    const a = agent.value;
    const p = startPose(a);
    if (!p) return `Appears at ${appearsAt(a)}`;
    const place = a.parked ? 'Parked' : sentenceCase(laneWords(editor.scene.value!.map, a, p.x, p.y, p.heading));
    return `${place} ·\u00a0id\u00a0${a.id}`;
  });
  return (
    <div class="ih">
      <div class={`ag t-${parked ? 'parked' : type}`}>
        <Icon name={kind} size={22} />
      </div>
      <div class="grow">
        <h2>{name}</h2>
        <p>{where}</p>
      </div>
      <IconButton id="follow" />
      <IconButton id="zoom-selection" />
    </div>
  );
}

function Warnings({ agent }: { agent: LiveAgent }) {
  const c = useApp();
  const list = useComputed(() => {
    const all = c.editor.motion.value.warnings?.get(agent.value.id);
    // That there is no lane is said once.
    return verdictOn(c, agent.value)?.snap ? all?.filter((w) => !w.startsWith('There is no lane')) : all;
  }).value;
  if (!list?.length) return null;
  return (
    <div class="sect">
      {list.map((w) => (
        <div key={w} class="hint plain">
          <Icon name="warn" size={17} />
          <div class="tx">{w}</div>
        </div>
      ))}
    </div>
  );
}

function Foot({ agent }: { agent: LiveAgent }) {
  const goal = useComputed(() => hasGoal(agent.value.goal)).value;
  const changed = useComputed(() => changedByHand(agent.value) && !agent.value.placed).value;
  return (
    <div class="sect foot">
      {goal ? (
        <ActionButton key="clear" id="clear-goal" class="line" icon="flag" size={15} />
      ) : (
        <ActionButton key="set" id="set-goal" class="goal" size={15} withKey />
      )}
      {changed ? <ActionButton id="reset-agent" class="line" icon="" size={15} /> : null}
    </div>
  );
}
