// The verdict on the goal, and the ways out of one that cannot be reached.
import { useComputed } from '@preact/signals';
import { byRoad, remedies, snapToNearest } from '../../edit/moves';
import { seconds } from '../../model/units';
import { useApp } from '../parts/app-context';
import { Icon } from '../parts/icons';
import type { LiveAgent } from './use-agent';
import { verdictOn, type Verdict } from './verdict';

export function Hint({ agent }: { agent: LiveAgent }) {
  const c = useApp();
  const v = useComputed(() => verdictOn(c, agent.value)).value;
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
      {v.byRoad ? <ByRoad agent={agent} /> : null}
      {v.remedies ? <Remedies agent={agent} /> : null}
      {v.snap ? <SnapButton agent={agent} /> : null}
    </div>
  );
}

/** What is wrong leads to the moment at which it is. */
function Title({ verdict: { title, at } }: { verdict: Verdict }) {
  const { editor } = useApp();
  if (at == null) return <b>{title}</b>;
  const go = () => {
    editor.playhead.pause();
    editor.setTime(at);
  };
  return (
    <button type="button" class="to" title={`Playhead to ${seconds(at)}`} onClick={go}>
      {title}
    </button>
  );
}

/** The nearest goal by the road, or the future that gets there by it. */
function ByRoad({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const way = useComputed(() => (editor.dragging.value ? null : byRoad(editor, agent.value))).value;
  if (!way) return null;
  return (
    <div class="stack">
      <button type="button" class="opt pri" onClick={() => editor.run(way.command)}>
        <Icon name={way.icon} size={15} />
        {way.label}
        <small>{way.note}</small>
      </button>
    </div>
  );
}

function Remedies({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const ways = useComputed(() => (editor.dragging.value ? [] : remedies(editor, agent.value))).value;
  if (!ways.length) return null;
  return (
    <div class="stack">
      {ways.map((w) => (
        <button
          key={w.label}
          type="button"
          class={`opt ${w.primary ? 'pri' : ''}`}
          onClick={() => editor.run(w.command)}
        >
          <Icon name={w.icon} size={15} />
          {w.label}
          <small>{w.note}</small>
        </button>
      ))}
    </div>
  );
}

function SnapButton({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const snap = () => {
    const to = snapToNearest(editor, agent.peek(), 'goal');
    if (to) editor.run(to);
  };
  return (
    <div class="stack">
      <button type="button" class="opt" onClick={snap}>
        <Icon name="fit" size={15} />
        Snap to nearest lane
      </button>
    </div>
  );
}
