// Reactions to the last change; during a drag, to a release now.
import { useComputed, useSignal } from '@preact/signals';
import type { Change } from '../../model/words/change-words';
import { useApp } from '../parts/app-context';
import { TEXTS } from '../../texts/panels/agent';

/** Beyond this number they are counted until all are requested: the futures below stay in sight. */
const LISTED = 4;

const others = (n: number): string => TEXTS.others(n);

export function Changes() {
  const { editor } = useApp();
  const previewed = useComputed(() => editor.answers.previewed.value).value;
  if (previewed) return <PreviewedChanges list={previewed} />;
  const list = editor.answers.changes.value;
  if (!list.length) return null;
  return (
    <section class="sect" aria-label={TEXTS.othersThatChanged}>
      <h3>
        {TEXTS.changed(others(list.length))}
        <button type="button" aria-pressed={editor.view.showBefore.value} onClick={() => editor.view.toggleBefore()}>
          {TEXTS.showBeforeAfter}
        </button>
      </h3>
      <Lines list={list} />
    </section>
  );
}

/** A preview: the dots are hollow. */
function PreviewedChanges({ list }: { list: readonly Change[] }) {
  if (!list.length) return null;
  return (
    <section class="sect previewed" aria-label={TEXTS.othersThatWould}>
      <h3>
        {TEXTS.wouldChange(others(list.length))}
        <small>{TEXTS.onRelease}</small>
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
          onClick={() => editor.playhead.moveTo(change.at)}
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
