// The field of a goal's relation: typed as a sentence, shown as it was understood.
import { useRef } from 'preact/hooks';
import { useComputed, useSignal, type ReadonlySignal } from '@preact/signals';
import { nameIn, type Agent } from '../../model/document/scene';
import { relationWords } from '../../model/words/relation-words';
import { endRelation } from '../../edit/moves/relating';
import { otherName, relationCommand } from '../../edit/tools/relations/typed-relation';
import { useApp } from '../parts/app-context';
import { titleOf } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { TEXTS } from '../../texts/editing/relation';
import type { LiveAgent } from './use-agent';

/** Long enough for the longest name and all parts. */
const MOST_CHARACTERS = 200;

const HOLD = 'hold-gap';

export function RelationRow({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const input = useRef<HTMLInputElement>(null);
  /** Typed text that is not committed; null where there is none. */
  const typed = useSignal<string | null>(null);
  const why = useSignal<string | null>(null);
  const inWords = (a: Agent): string => {
    const { relation, time } = a.goal;
    const name = relation && nameIn(editor.scene.value!)(relation.to);
    return relation ? relationWords(relation, name ?? relation.to, time, editor.view.unitOf(a)) : '';
  };
  const shown = useComputed(() => inWords(agent.value));
  const text = useComputed(() => typed.value ?? shown.value);
  const example = useComputed(() => TEXTS.example(otherName(editor.scene.value!, agent.value)));
  const bad = useComputed(() => why.value !== null);
  const isSet = useComputed(() => agent.value.goal.relation !== undefined).value;
  const reset = () => {
    typed.value = why.value = null;
  };
  const done = () => {
    const [a, words] = [agent.peek(), typed.peek()?.trim()];
    if (words === undefined || words === shown.peek()) return reset();
    if (!words) {
      editor.commits.run(endRelation(editor, a));
      return reset();
    }
    const made = relationCommand(editor, a, words);
    if (typeof made === 'string') {
      why.value = made;
      return;
    }
    editor.commits.run(made);
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
            aria-invalid={bad}
            placeholder={example}
            maxlength={MOST_CHARACTERS}
            spellcheck={false}
            value={text}
            title={shown}
            onInput={(e) => {
              typed.value = e.currentTarget.value;
              why.value = null;
            }}
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
        ) : null}
      </div>
      <Refusal why={why} />
    </>
  );
}

/** The gap to a road user beside the goal, which one press holds. */
export function GapOfferButton() {
  const { gapOffer } = useApp();
  const offer = gapOffer.now.value;
  return offer ? (
    <button type="button" class="opt gap" data-action={HOLD} title={titleOf(HOLD)} onClick={() => gapOffer.accept()}>
      <Icon name="link" size={15} />
      {offer.words}
    </button>
  ) : null;
}

/** Why typed text is refused. */
function Refusal({ why }: { why: ReadonlySignal<string | null> }) {
  return why.value === null ? null : (
    <p class="note" role="alert">
      {why.value}
    </p>
  );
}
