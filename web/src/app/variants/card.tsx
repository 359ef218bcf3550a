// One variant: its picture, its name, what happens in it, and what is thought of it.
import { useEffect, useRef } from 'preact/hooks';
import { useComputed } from '@preact/signals';
import { counted, worstOf, type TrafficEvent } from '../../model/events';
import { num, seconds } from '../../model/units';
import type { Card } from '../../edit/variants/cards';
import { useApp } from '../parts/app-context';
import { Icon } from '../parts/icons';
import { LivePicture, type Album } from './live-picture';

const MARKS: Record<TrafficEvent['kind'], readonly [colour: string, word: string]> = {
  collision: ['collision', 'Collision'],
  rule: ['collision', 'Rule broken'],
  near: ['near', 'Near miss'],
  short: ['near', 'Goal missed'],
};

/** What happens in it, in a word with its colour, and one fact. */
export function verdictOf({ set, events }: Card): { colour: string; word: string; fact: string } {
  const worst = worstOf(events);
  if (!set) return { colour: '', word: '…', fact: '' };
  if (!worst) {
    const pet = set.score?.pet;
    return { colour: 'ok', word: 'No conflict', fact: pet == null ? '' : `gap ${num(pet, 1)} s` };
  }
  const [colour, word] = MARKS[worst];
  const first = counted(events).find((e) => e.kind === worst)!;
  return { colour, word, fact: `${seconds(first.time)}, ${first.b?.name ?? first.a.name}` };
}

export function CardView({ card, album }: { card: Card; album: Album }) {
  const { variants } = useApp();
  const { id, variant: v } = card;
  const shown = useComputed(() => variants.shown.value === id).value;
  const side = useComputed(() => {
    const pair = variants.pair.value;
    if (pair) return pair[0] === id ? 'left' : pair[1] === id ? 'right' : null;
    return variants.picked.value === id ? 'first' : null;
  }).value;
  const renaming = useComputed(() => variants.renaming.value === id).value;
  const verdict = verdictOf(card);
  const words = `Variant ${id}, ${card.name}, ${verdict.word}${verdict.fact ? `, ${verdict.fact}` : ''}`;
  return (
    <article
      class={`vcard ${shown ? 'on' : ''} ${side ? 'side' : ''} ${card.scene ? '' : 'gone'}`}
      data-variant={id}
      draggable
      onDragStart={(e) => e.dataTransfer?.setData('text/x-variant', String(id))}
      onDragOver={(e) => {
        if (e.dataTransfer?.types.includes('text/x-variant')) e.preventDefault();
      }}
      onDrop={(e) => {
        const from = Number(e.dataTransfer?.getData('text/x-variant'));
        if (!from) return;
        e.preventDefault();
        e.stopPropagation();
        variants.compare(id, from);
      }}
    >
      <button
        type="button"
        class="face"
        data-plays
        aria-label={words}
        aria-pressed={shown}
        onClick={() => variants.take(id)}
        onFocus={() => variants.focus(id)}
        onBlur={() => variants.focus(null)}
      >
        {card.set ? (
          <LivePicture card={card} album={album} />
        ) : (
          <span class="blank">{card.scene ? 'Working it out …' : 'Other road users were here then.'}</span>
        )}
      </button>
      {side ? <em class="badge-side">{side}</em> : null}
      <button
        type="button"
        class={`star ${v.starred ? 'on' : ''}`}
        aria-label={`Star variant ${id}`}
        aria-pressed={v.starred}
        title="Star (S)"
        onClick={() => variants.toggleStar(id)}
      >
        <Icon name="star" size={14} />
      </button>
      <div class="named">
        {renaming ? <NameField card={card} /> : <Name card={card} />}
        <button
          type="button"
          class={`keep ${v.kept ? 'on' : ''}`}
          aria-pressed={v.kept}
          aria-label={`Keep variant ${id}`}
          title="Keep (Ctrl D)"
          onClick={() => variants.toggleKept(id)}
        >
          {v.kept ? (
            <>
              <Icon name="check" size={12} /> Kept
            </>
          ) : (
            'Keep'
          )}
        </button>
      </div>
      <div class="verdict">
        <span class={`tag ${verdict.colour}`}>{verdict.word}</span>
        <small>{verdict.fact}</small>
      </div>
    </article>
  );
}

function Name({ card }: { card: Card }) {
  const { variants } = useApp();
  return (
    <b title={`${card.name}\nDouble click: another name`} onDblClick={() => variants.startRenaming(card.id)}>
      <i>{card.id}</i> {card.name}
    </b>
  );
}

function NameField({ card }: { card: Card }) {
  const { variants } = useApp();
  const input = useRef<HTMLInputElement>(null);
  useEffect(() => input.current!.select(), []);
  return (
    <input
      ref={input}
      type="text"
      aria-label={`Name of variant ${card.id}`}
      maxlength={60}
      defaultValue={card.variant.called ?? card.name}
      onBlur={() => variants.rename(card.id, named(input.current!.value, card))}
      onKeyDown={(e) => {
        if (e.key === 'Enter') input.current!.blur();
        if (e.key !== 'Escape') return;
        e.stopPropagation();
        variants.startRenaming(null);
      }}
    />
  );
}

/** What was left as it stood is no name of one's own. */
const named = (typed: string, { variant, name }: Card): string =>
  variant.called === null && typed.trim() === name ? '' : typed;
