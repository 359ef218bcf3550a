// Who else does something else since the last change.
import { useApp } from '../parts/app-context';

/** More than these are counted, not listed. */
const LISTED = 8;

export function Changes() {
  const { editor } = useApp();
  const list = editor.changes.value;
  const scene = editor.scene.peek();
  if (!list.length || !scene) return null;
  return (
    <section class="sect" aria-label="Others that changed">
      <h3>
        {`${list.length} other${list.length > 1 ? 's' : ''} changed`}
        <button type="button" aria-pressed={editor.showBefore.value} onClick={() => editor.toggleBefore()}>
          show before / after
        </button>
      </h3>
      {list.slice(0, LISTED).map((change) => (
        <button
          key={change.id}
          type="button"
          class="ch"
          title={`${change.name} ${change.words}`}
          onClick={() => editor.setTime(change.at)}
          onPointerEnter={() => editor.pointAt({ agent: change.id })}
          onPointerLeave={() => editor.pointAt({})}
        >
          <i class={`b-${scene.agents.get(change.id)!.type}`} />
          <b>{change.name}</b>
          <span>{change.words}</span>
        </button>
      ))}
      {list.length > LISTED ? <p class="note">and {list.length - LISTED} more</p> : null}
    </section>
  );
}
