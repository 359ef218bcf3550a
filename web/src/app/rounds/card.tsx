// One card of a round: its picture, what it is like, and what is said of it. Pulled up it is kept, down rejected.
import { useRef } from 'preact/hooks';
import { useComputed, useSignal } from '@preact/signals';
import { factWords, reasons, wishKey } from '../../model/words/feedback-words';
import { LETTERS } from '../../model/document/futures';
import { nameIn } from '../../model/document/scene';
import type { Hand } from '../../edit/rounds/deck';
import type { Pictured } from '../../edit/variants/cards';
import { LivePicture, type Album } from '../variants/live-picture';
import { useApp } from '../parts/app-context';
import { Icon } from '../parts/icons';
import { TEXTS } from '../../texts/panels/rounds-panel';

const WORDS = { keep: TEXTS.kept, reject: TEXTS.rejected } as const;

interface Props {
  readonly hand: Hand;
  readonly index: number;
  readonly picture: Pictured;
  readonly album: Album;
}

export function CardView({ hand, index, picture, album }: Props) {
  const { editor, rounds } = useApp();
  const { deck } = editor;
  const said = useComputed(() => rounds.said.value[index] ?? null).value;
  const current = useComputed(() => deck.current.value === index).value;
  const { features } = hand.round.cards[index];
  const letter = LETTERS[index];
  const name = hand.names[index];
  const verdict = said?.verdict ?? null;
  const words = verdict ? WORDS[verdict] : TEXTS.open;
  const point = () => deck.point(index);
  const pull = usePull((up) => rounds.say(index, up ? 'keep' : 'reject'));
  return (
    <article
      class={`rcard ${verdict ?? ''} ${current ? 'on' : ''}`}
      data-card={letter}
      {...pull}
      onPointerEnter={() => editor.pointAt({ future: index })}
      onPointerLeave={() => editor.pointAt({})}
      onKeyDown={(e) => {
        // The card has the focus: Enter takes what was kept.
        if (e.key !== 'Enter' || verdict !== 'keep' || !(e.target as Element).closest('.face')) return;
        e.preventDefault();
        e.stopPropagation();
        rounds.take(index);
      }}
    >
      <button
        type="button"
        class="face"
        aria-label={`${letter}, ${name}, ${words}, ${factWords(features)}`}
        data-plays
        aria-current={current}
        onClick={point}
        onFocus={point}
      >
        <LivePicture card={picture} album={album} />
        <span class={`l m${index}`}>{letter}</span>
        {verdict ? (
          <em class={`tag ${verdict === 'keep' ? 'ok' : 'no'}`}>
            <Icon name={verdict === 'keep' ? 'check' : 'x'} size={11} />
            {words}
          </em>
        ) : null}
      </button>
      <b class="nm" title={name}>
        {name}
      </b>
      <small>{factWords(features)}</small>
      <div class="say">
        <button
          type="button"
          class={`btn keep ${verdict === 'keep' ? 'on' : ''}`}
          aria-pressed={verdict === 'keep'}
          onClick={() => rounds.say(index, 'keep')}
        >
          <Icon name="check" size={13} />
          {TEXTS.keep}
        </button>
        <button
          type="button"
          class={`btn reject ${verdict === 'reject' ? 'on' : ''}`}
          aria-pressed={verdict === 'reject'}
          onClick={() => rounds.say(index, 'reject')}
        >
          <Icon name="x" size={13} />
          {TEXTS.reject}
        </button>
      </div>
      <div class="more">
        <Why hand={hand} index={index} />
        <button
          type="button"
          class="btn i"
          data-take={letter}
          aria-label={TEXTS.take(letter)}
          title={TEXTS.takeThisOneThe(index + 1)}
          onClick={() => rounds.take(index)}
        >
          <Icon name="flag" size={14} />
        </button>
      </div>
    </article>
  );
}

/** So far a card is pulled before it counts, and so far it can be pulled, pixels. */
const PULLED_PX = 48;
const FURTHEST_PX = 72;
/** Less is the tremble of a click. */
const TREMBLE_PX = 6;

/** Where a card is pulled to by its face, and what it says when it is let go. */
function usePull(say: (up: boolean) => void) {
  const from = useRef<number | null>(null);
  const by = useSignal(0);
  const moved = useRef(false);
  const end = () => {
    from.current = null;
    by.value = 0;
  };
  return {
    style: { translate: by.value ? `0 ${by.value}px` : '' },
    'data-pull': Math.abs(by.value) < PULLED_PX ? undefined : by.value < 0 ? 'keep' : 'reject',
    onPointerDown: (e: PointerEvent) => {
      moved.current = false;
      if (e.button === 0 && (e.target as Element).closest('.face')) from.current = e.clientY;
    },
    onPointerMove: (e: PointerEvent & { currentTarget: HTMLElement }) => {
      if (from.current === null) return;
      const d = e.clientY - from.current;
      if (!moved.current && Math.abs(d) < TREMBLE_PX) return;
      if (!moved.current) e.currentTarget.setPointerCapture(e.pointerId);
      moved.current = true;
      by.value = Math.max(-FURTHEST_PX, Math.min(FURTHEST_PX, d));
    },
    onPointerUp: (e: PointerEvent & { currentTarget: HTMLElement }) => {
      const d = by.peek();
      end();
      // What was pulled is not what the next key is about.
      if (moved.current) e.currentTarget.querySelector<HTMLElement>('.face')?.blur();
      if (Math.abs(d) >= PULLED_PX) say(d < 0);
    },
    onPointerCancel: end,
  };
}

function Why({ hand, index }: { hand: Hand; index: number }) {
  const { editor, rounds } = useApp();
  const said = rounds.said.value[index] ?? null;
  const scene = editor.scene.value;
  if (!scene) return null;
  const all = reasons(hand.id, hand.round.cards[index].features, said?.verdict ?? 'reject', nameIn(scene));
  const now = said?.why ? wishKey(said.why) : '';
  return (
    <select
      class="field pick"
      aria-label={TEXTS.why(LETTERS[index])}
      value={all.some((w) => w.key === now) ? now : ''}
      onChange={(e) => {
        rounds.sayWhy(index, e.currentTarget.value);
        e.currentTarget.blur();
      }}
    >
      <option value="">{said?.verdict === 'keep' ? TEXTS.whyAllInAll : TEXTS.whyAsked}</option>
      {all.map((w) => (
        <option key={w.key} value={w.key}>
          {w.words}
        </option>
      ))}
    </select>
  );
}
