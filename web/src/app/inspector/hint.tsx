// The verdict on the goal, and the ways out of one that cannot be reached.
import { useComputed } from '@preact/signals';
import { remedies, snapToNearest } from '../../edit/moves';
import { useApp } from '../parts/app-context';
import { Icon } from '../parts/icons';
import type { LiveAgent } from './use-agent';
import { verdictOn } from './verdict';

export function Hint({ agent }: { agent: LiveAgent }) {
  const c = useApp();
  const v = useComputed(() => verdictOn(c, agent.value)).value;
  if (!v) return null;
  return (
    <div class="sect">
      <div class={`hint ${v.kind}`}>
        <Icon name={v.icon} size={17} />
        <div>
          <b>{v.title}</b>
          <div class="tx">{v.words}</div>
        </div>
      </div>
      {v.remedies ? <Remedies agent={agent} /> : null}
      {v.snap ? <SnapButton agent={agent} /> : null}
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
