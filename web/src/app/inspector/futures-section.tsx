// The six futures of a road user: names, shares, and which one it takes.
import { useComputed } from '@preact/signals';
import { isSettled, LETTERS } from '../../model/futures';
import { hasGoal } from '../../model/scene';
import { pickFuture } from '../../edit/moves';
import { useApp } from '../parts/app-context';
import type { LiveAgent } from './use-agent';

export function FuturesSection({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const note = useComputed(() => {
    const f = editor.futures.value;
    const a = agent.value;
    if (!f) return editor.status.value.kind === 'refining' ? 'working' : '';
    if (f.sketch) return 'sketch, generator away';
    if (!isSettled(f)) return f.step ? `step ${f.step} of ${f.steps}` : 'first guess';
    if (editor.outdated.value) return 'from before the last change';
    if (a.chosen !== null) return `chosen: ${LETTERS[a.chosen]}`;
    const n = f.modes.length === 6 ? 'six' : f.modes.length;
    return hasGoal(a.goal) ? `of ${n}` : `${n}, no goal set`;
  });
  return (
    <section class="sect last" aria-label="Futures">
      <h3>
        Futures
        <small>{note}</small>
      </h3>
      <FutureList agent={agent} />
    </section>
  );
}

function FutureList({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const count = useComputed(() => editor.futures.value?.modes.length ?? 0).value;
  const sketch = useComputed(() => editor.futures.value?.sketch ?? false).value;
  if (!count) return <Waiting />;
  if (sketch) return <p class="mut">A plain curve is shown until the generator answers.</p>;
  return (
    <div role="radiogroup" aria-label="Futures">
      {[...LETTERS].slice(0, count).map((letter, i) => (
        <FutureRow key={letter} agent={agent} index={i} />
      ))}
    </div>
  );
}

function Waiting() {
  const { editor } = useApp();
  const words = useComputed(() => {
    if (editor.away.value) return 'Waiting for the generator.';
    return editor.status.value.kind === 'refused' ? 'None: see below the picture.' : 'Working them out …';
  });
  return <p class="mut">{words}</p>;
}

function FutureRow({ agent, index }: { agent: LiveAgent; index: number }) {
  const { editor } = useApp();
  const mode = useComputed(() => editor.futures.value?.modes[index]);
  const name = useComputed(() => mode.value?.name ?? '');
  const percent = useComputed(() => `${Math.round((mode.value?.probability ?? 0) * 100)}%`);
  const checked = useComputed(() => String(editor.chosen.value === index));
  const pick = () => {
    const command = agent.peek().chosen === index ? null : pickFuture(editor, agent.peek(), index);
    if (command) editor.run(command);
  };
  const point = () => editor.pointAt({ future: index });
  const leave = () => editor.pointAt({});
  return (
    <button
      type="button"
      class="fu"
      role="radio"
      data-future={LETTERS[index]}
      aria-checked={checked as never}
      title={name}
      onClick={pick}
      onPointerEnter={point}
      onPointerLeave={leave}
      onFocus={point}
      onBlur={leave}
    >
      <span class={`l m${index}`}>{LETTERS[index]}</span>
      <span class="nm">{name}</span>
      <span class="bar">
        <Share index={index} />
      </span>
      <span class="pc">{percent}</span>
    </button>
  );
}

/** A bar as long as the future is likely, beside the likeliest. */
function Share({ index }: { index: number }) {
  const { editor } = useApp();
  const share = useComputed(() => {
    const modes = editor.futures.value?.modes ?? [];
    return (modes[index]?.probability ?? 0) / Math.max(...modes.map((m) => m.probability), 1e-9);
  });
  return <i class={`m${index}`} style={{ width: `${share.value * 100}%` }} />;
}
