// The field of a goal's relation: typed as a sentence, shown as it was understood.
import { useRef } from 'preact/hooks';
import { useComputed, useSignal } from '@preact/signals';
import { nameIn, type Agent } from '../../model/document/scene';
import { relationWords } from '../../model/words/relation-words';
import { endRelation, relate } from '../../edit/moves/relating';
import { readRelation } from '../../edit/tools/relations/typed-relation';
import { useApp } from '../parts/app-context';
import { Icon } from '../parts/icons';
import { TEXTS } from '../../texts/editing/relation';
import type { LiveAgent } from './use-agent';

/** Long enough for the longest name and all parts. */
const MOST_CHARACTERS = 200;

export function RelationRow({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const input = useRef<HTMLInputElement>(null);
  const why = useSignal<string | null>(null);
  const inWords = (a: Agent): string => {
    const { relation, time } = a.goal;
    const name = relation && nameIn(editor.scene.value!)(relation.to);
    return relation ? relationWords(relation, name ?? relation.to, time, editor.view.unitOf(a)) : '';
  };
  const shown = useComputed(() => inWords(agent.value));
  const isSet = useComputed(() => agent.value.goal.relation !== undefined).value;
  const reset = () => {
    input.current!.value = shown.peek();
    why.value = null;
  };
  const done = () => {
    const [a, text] = [agent.peek(), input.current?.value.trim() ?? ''];
    if (text === shown.peek()) return;
    if (!text) {
      editor.commits.run(endRelation(editor, a));
      return;
    }
    const read = readRelation(text, editor.scene.peek()!, a);
    const { relation, time } = read.why === undefined ? read : { relation: null, time: null };
    const command = relation && relate(editor, a, relation, time, text);
    why.value = read.why ?? (command ? null : TEXTS.setPlace);
    if (!command) return;
    editor.commits.run(command);
    reset();
  };
  return (
    <>
      <div class="pr relation">
        <span class="lab">{TEXTS.relative}</span>
        <div class="fs">
          <input
            ref={input}
            type="text"
            class="field"
            data-text="relation"
            aria-label={TEXTS.goalRelativeTo}
            aria-invalid={why.value !== null}
            placeholder={TEXTS.example}
            maxlength={MOST_CHARACTERS}
            spellcheck={false}
            value={shown}
            title={shown}
            onInput={() => (why.value = null)}
            onBlur={done}
            onKeyDown={(e) => {
              if (e.key === 'Escape') reset();
              if (e.key === 'Enter') done();
              if (e.key !== 'Enter' && e.key !== 'Escape') return;
              if (why.peek() === null) input.current!.blur();
              e.stopPropagation();
            }}
          />
        </div>
        {isSet ? (
          <button
            type="button"
            class="off"
            aria-label={TEXTS.end}
            title={TEXTS.end}
            onClick={() => editor.commits.run(endRelation(editor, agent.peek()))}
          >
            <Icon name="x" size={12} />
          </button>
        ) : (
          <span />
        )}
      </div>
      {why.value === null ? null : (
        <p class="note" role="alert">
          {why}
        </p>
      )}
    </>
  );
}
