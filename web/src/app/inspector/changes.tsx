// Who else does something else since the last change; during a drag, who would if one let go now.
import { useComputed, useSignal } from '@preact/signals';
import type { Change } from '../../model/words/change-words';
import { useApp } from '../parts/app-context';
import { TEXTS } from '../../texts/panels/agent';

/** More than these are counted until somebody asks for all. */
const LISTED = 8;

const others = (n: number): string => TEXTS.others(n);

export function Changes() {
  const { editor } = useApp();
  const foreseen = useComputed(() => editor.foreseen.value).value;
  if (foreseen) return <Foreseen list={foreseen} />;
  const list = editor.changes.value;
  if (!list.length) return null;
  return (
    <section class="sect" aria-label={TEXTS.othersThatChanged}>
      <h3>
        {TEXTS.changed(others(list.length))}
        <button type="button" aria-pressed={editor.showBefore.value} onClick={() => editor.toggleBefore()}>
          {TEXTS.showBeforeAfter}
        </button>
      </h3>
      <Lines list={list} />
    </section>
  );
}

/** Nothing of it has happened yet: the dots are hollow. */
function Foreseen({ list }: { list: readonly Change[] }) {
  if (!list.length) return null;
  return (
    <section class="sect foreseen" aria-label={TEXTS.othersThatWould}>
      <h3>
        {TEXTS.wouldChange(others(list.length))}
        <small>{TEXTS.ifYouLetGoNow}</small>
      </h3>
      <Lines list={list} />
    </section>
  );
}

function Lines({ list }: { list: readonly Change[] }) {
  const { editor } = useApp();
  const scene = editor.scene.peek();
  const whole = useSignal(false);
  const more = whole.value ? 0 : list.length - LISTED;
  return (
    <>
      {list.slice(0, whole.value ? list.length : LISTED).map((change) => (
        <button
          key={change.id}
          type="button"
          class="ch"
          title={`${change.name} ${change.words}`}
          onClick={() => editor.setTime(change.at)}
          onPointerEnter={() => editor.pointAt({ agent: change.id })}
          onPointerLeave={() => editor.pointAt({})}
        >
          <i class={`b-${scene?.agents.get(change.id)?.type ?? 'other'}`} />
          <b>{change.name}</b>
          <span>{change.words}</span>
        </button>
      ))}
      {more > 0 ? (
        <button
          type="button"
          class="note more"
          onClick={() => {
            whole.value = true;
          }}
        >
          {TEXTS.andMore(more)}
        </button>
      ) : null}
    </>
  );
}
