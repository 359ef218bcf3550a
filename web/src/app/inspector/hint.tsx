// The verdict on the goal, and the remedies for an unreachable one.
import { useComputed } from '@preact/signals';
import { actionOf, perform } from '../../actions/registry';
import { snapToNearest } from '../../edit/moves/moves';
import { lessTime, moreTime, remedies } from '../../edit/moves/remedies';
import { leaveToCross, roadWay } from '../../edit/moves/ways-out';
import { seconds } from '../../model/base/units';
import type { Command } from '../../model/document/commands';
import { useApp } from '../parts/app-context';
import { RemedyButton } from '../parts/remedy-button';
import { useTrying } from '../parts/trying';
import { KeyCaps, titleOf } from '../parts/buttons';
import { Icon } from '../parts/icons';
import type { LiveAgent } from './use-agent';
import { verdictOn, type AgentVerdict } from './verdict';
import { TEXTS } from '../../texts/panels/agent';

export function Hint({ agent }: { agent: LiveAgent }) {
  const c = useApp();
  const v = useComputed(() => verdictOn(c, agent)).value;
  if (!v) return null;
  return (
    <div class="sect">
      <div class={`hint ${v.kind}`}>
        <Icon name={v.icon} size={17} />
        <div>
          <Title verdict={v} />
          {v.words ? <div class="tx">{v.words}</div> : null}
        </div>
      </div>
      <OtherTime agent={agent} />
      <WaysOut agent={agent} />
      {v.remedies ? <Remedies agent={agent} /> : null}
      {v.snap ? <SnapButton agent={agent} /> : null}
    </div>
  );
}

/** A click on a fault moves the playhead to it. */
function Title({ verdict: { title, at } }: { verdict: AgentVerdict }) {
  const { editor } = useApp();
  if (at == null) return <b>{title}</b>;
  const go = () => {
    editor.playhead.pause();
    editor.playhead.moveTo(at);
  };
  return (
    <button type="button" class="to" title={TEXTS.playheadTo(seconds(at))} onClick={go}>
      {title}
    </button>
  );
}

/** Before all else: without time the others only move the goal or break rules. */
function OtherTime({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const remedy = useComputed(() => moreTime(editor, agent.value) ?? lessTime(editor, agent.value)).value;
  if (!remedy) return null;
  return (
    <div class="stack">
      <RemedyButton remedy={remedy} />
    </div>
  );
}

/** By road first; then permission to cross the edge. */
function WaysOut({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const road = useComputed(() => roadWay(editor, agent.value)).value;
  const leave = useComputed(() => leaveToCross(editor, agent.value)).value;
  const hurried = useComputed(() => moreTime(editor, agent.value) !== null).value;
  const dragging = editor.drag.active.value;
  if (!road && !leave) return null;
  return (
    <div class="stack">
      {road ? <WayOut id="by-road" primary={!hurried} {...road} cap="Enter" /> : null}
      {leave ? <WayOut id="may-cross" {...leave} cap={dragging ? 'Alt' : undefined} /> : null}
    </div>
  );
}

interface WayOutProps {
  id: string;
  words: string;
  command: Command;
  note?: string;
  /** The key to show; space is short. */
  cap?: string;
  primary?: boolean;
}

function WayOut({ id, words, note, cap, primary, command }: WayOutProps) {
  const c = useApp();
  const { icon } = actionOf(id);
  return (
    <button
      type="button"
      {...useTrying(command)}
      data-action={id}
      title={titleOf(id)}
      class={`opt ${primary ? 'pri' : ''}`}
      onClick={() => perform(c, id)}
    >
      <Icon name={icon!} size={15} />
      {words}
      {note ? <small>{note}</small> : null}
      {cap ? <KeyCaps of={cap} /> : null}
    </button>
  );
}

function Remedies({ agent }: { agent: LiveAgent }) {
  const c = useApp();
  const { editor } = c;
  const ways = useComputed(() => (editor.drag.active.value ? [] : remedies(editor, agent.value))).value;
  if (!ways.length) return null;
  return (
    <div class="stack">
      {ways.map((w) => (
        <RemedyButton key={w.label} remedy={w} />
      ))}
    </div>
  );
}

function SnapButton({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const command = useComputed(() => snapToNearest(editor, agent.value, 'goal')).value;
  if (!command) return null;
  const remedy = { label: TEXTS.snapToNearest, note: '', icon: 'fit', primary: false, command };
  return (
    <div class="stack">
      <RemedyButton remedy={remedy} />
    </div>
  );
}
