// The inspector of one road user: verdict on the goal, start, goal, six futures, who changed.
import type { ComponentChildren, RefObject } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import { useComputed } from '@preact/signals';
import { seenUntil } from '../../model/physics/playback';
import { canChange, changedByHand, hasGoal, startPose, touched, type Agent } from '../../model/document/scene';
import { messageText } from '../../model/words/message-text';
import { seconds } from '../../model/base/units';
import { goalFromLog } from '../../edit/moves';
import { callIt, noteOn } from '../../edit/several';
import { laneWords } from '../../edit/snap';
import { useApp } from '../parts/app-context';
import { ActionButton, IconButton, Segments } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { Changes } from './changes';
import { CurveSection } from './curve-section';
import { FuturesSection } from './futures-section';
import { Hint } from './hint';
import { GoalSection, StartSection } from './part-sections';
import { ViasSection } from './vias-section';
import { useAgent, type LiveAgent } from './use-agent';
import { verdictOn } from './verdict';
import { TEXTS } from '../../texts/panels/agent';

// Beside it in one script: who is selected has both at once.
export { Sliders } from '../access/sliders';

export function AgentPanel({ id }: { id: string }) {
  const agent = useAgent(id);
  const first = agent.peek();
  return (
    <>
      <Head agent={agent} />
      {canChange(first) ? (
        <>
          <Locked agent={agent}>
            <Hint agent={agent} />
            <Warnings agent={agent} />
            <CurveSection agent={agent} />
            <StartSection agent={agent} />
            <ViasSection agent={agent} />
            <GoalSection agent={agent} />
          </Locked>
          <FuturesSection agent={agent} />
          <Changes />
          <NoteSection agent={agent} />
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

const whyNot = (a: Agent): string => (a.type === 'other' ? TEXTS.objectsOfThis : TEXTS.onlyRoadUsers(appearsAt(a)));

const sentenceCase = (s: string): string => s.charAt(0).toUpperCase() + s.slice(1);

function Head({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const kind = useComputed(() => agent.value.kind).value;
  const colour = useComputed(() => (agent.value.parked ? 'parked' : agent.value.type)).value;
  const where = useComputed(() => {
    const a = agent.value;
    const p = startPose(a);
    if (!p) return TEXTS.appearsAt(appearsAt(a));
    const place = a.parked ? TEXTS.parked : sentenceCase(laneWords(editor.scene.value!.map, a, p.x, p.y, p.heading));
    const until = seenUntil(editor.scene.value!, editor.motion.value, a);
    const seen = until === null ? place : TEXTS.seenUntil(seconds(until), place);
    // Where the name says it already the place has the room.
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
      <IconButton id="follow" />
      <IconButton id="zoom-selection" />
      <IconButton id="menu" icon="more" />
    </div>
  );
}

/** The verdict in a line, for where there is no room for more. */
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

/** The name, to be changed in place; emptied, it is the kind and the number again. */
function NameField({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const input = useRef<HTMLInputElement>(null);
  const name = useComputed(() => agent.value.name);
  const done = () => {
    if (!input.current) return;
    const typed = input.current.value.trim();
    if (typed !== name.peek()) editor.run(callIt(agent.peek(), typed || null));
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

/** What is locked is shown, not changed. */
function Locked({ agent, children }: { agent: LiveAgent; children: ComponentChildren }) {
  const fields = useRef<HTMLFieldSetElement>(null);
  useSteady(fields);
  const locked = useComputed(() => agent.value.locked).value;
  return (
    <>
      {locked ? (
        <div class="sect lockline">
          <Icon name="lock" size={15} />
          <span class="grow">{TEXTS.lockedItStays}</span>
          <ActionButton id="lock" class="line" icon="" size={15}>
            {TEXTS.unlock}
          </ActionButton>
        </div>
      ) : null}
      <fieldset ref={fields} class="fields" disabled={locked}>
        {children}
      </fieldset>
    </>
  );
}

/** Who works in the panel keeps the fields under the hand, however many lines the verdict above them takes. */
function useSteady(fields: RefObject<HTMLFieldSetElement | null>): void {
  useEffect(() => {
    const within = fields.current!;
    const panel = within.closest<HTMLElement>('.insp');
    const below = () => within.querySelector<HTMLElement>('.curve, .startsec');
    let [first, was] = [below(), below()?.offsetTop ?? 0];
    const watch = new ResizeObserver(() => {
      const now = below();
      const by = now && now === first ? now.offsetTop - was : 0;
      [first, was] = [now, now?.offsetTop ?? 0];
      // The verdict itself stays in sight: no more than the head gives way.
      const most = Math.max(panel?.scrollTop ?? 0, within.offsetTop);
      if (by && panel?.matches(':hover, :focus-within')) panel.scrollTop = Math.min(panel.scrollTop + by, most);
    });
    watch.observe(within);
    return () => watch.disconnect();
  }, [fields]);
}

/** A note of one's own, and what it does while others change. */
function NoteSection({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const area = useRef<HTMLTextAreaElement>(null);
  const note = useComputed(() => agent.value.note);
  const asked = useComputed(() => touched(agent.value)).value;
  return (
    <section class="sect">
      {asked ? null : (
        <>
          <h3>
            {TEXTS.whileOthersChange}
            <small>{TEXTS.thisOneAlone}</small>
          </h3>
          <Segments
            label={TEXTS.whatItDoesWhile}
            items={[
              ['does-react', TEXTS.reacts],
              ['does-log', TEXTS.replaysLog],
              ['does-still', TEXTS.holdsStill],
            ]}
          />
        </>
      )}
      <textarea
        ref={area}
        class="notes"
        data-text="note"
        aria-label={TEXTS.note}
        placeholder={TEXTS.note}
        rows={1}
        maxlength={2000}
        value={note}
        onBlur={() => {
          if (!area.current) return;
          const typed = area.current.value.trim();
          if (typed !== note.peek()) editor.run(noteOn(agent.peek(), typed));
        }}
        onKeyDown={(e) => {
          if (e.key === 'Escape') {
            area.current!.value = note.peek();
            area.current!.blur();
            e.stopPropagation();
          }
        }}
      />
    </section>
  );
}

const OFF_ROAD: ReadonlySet<string> = new Set(['goal-off-road', 'start-off-road']);

function Warnings({ agent }: { agent: LiveAgent }) {
  const c = useApp();
  const list = useComputed(() => {
    const all = c.editor.motion.value.warnings?.get(agent.value.id);
    // The verdict says that there is no lane.
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

function Foot({ agent }: { agent: LiveAgent }) {
  const goal = useComputed(() => hasGoal(agent.value.goal)).value;
  const changed = useComputed(() => changedByHand(agent.value) && !agent.value.placed).value;
  const recorded = useComputed(() => goalFromLog(agent.value) !== null).value;
  return (
    <div class="sect foot">
      {goal ? (
        <ActionButton key="clear" id="clear-goal" class="line" icon="flag" size={15} />
      ) : (
        <ActionButton key="set" id="set-goal" class="goal" size={15} withKey />
      )}
      {!goal && recorded && !changed ? (
        <ActionButton key="log" id="goal-from-log" class="line" icon="">
          {TEXTS.asInTheLog}
        </ActionButton>
      ) : null}
      {changed ? <ActionButton id="reset-agent" class="line" icon="" size={15} /> : null}
    </div>
  );
}
