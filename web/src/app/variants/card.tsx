// A variant: picture, name, events and rating.
import { useEffect, useRef } from 'preact/hooks';
import { useComputed } from '@preact/signals';
import { closeInTime, counted, worstOf } from '../../model/physics/events';
import type { TrafficEvent } from '../../model/words/event-words';
import { num, seconds } from '../../model/base/units';
import type { Card, Pictured } from '../../edit/tools/variants/cards';
import { useApp } from '../parts/app-context';
import { Icon } from '../parts/icons';
import { LivePicture, type Album } from './live-picture';
import { TEXTS } from '../../texts/panels/variants-panel';

const MARKS: Record<TrafficEvent['kind'], readonly [colour: string, word: string]> = {
  collision: ['collision', TEXTS.collision],
  rule: ['collision', TEXTS.ruleBroken],
  near: ['near', TEXTS.nearMiss],
  short: ['near', TEXTS.goalMissed],
};

/** Its events as a word with a colour, and one fact. */
export function verdictOf({ set, events }: Pictured): { colour: string; word: string; fact: string } {
  const worst = worstOf(events);
  if (!set) return { colour: '', word: '…', fact: '' };
  if (!worst) {
    const pet = set.score?.pet;
    const fact = pet == null ? '' : TEXTS.petS(num(pet, 1));
    const close = closeInTime(set) !== null;
    return { colour: close ? 'near' : 'ok', word: close ? TEXTS.close : TEXTS.noConflict, fact };
  }
  const [colour, word] = MARKS[worst];
  const first = counted(events).find((e) => e.kind === worst)!;
  return { colour, word, fact: `${seconds(first.time)}, ${first.b?.name ?? first.a.name}` };
}

const SIDES = TEXTS.sides;

export function CardView({ card, album }: { card: Card; album: Album }) {
  const { variants } = useApp();
  const { id, variant: v } = card;
  const shown = useComputed(() => variants.shown.value === id).value;
  const side = useComputed(() => {
    const pair = variants.comparing.pair.value;
    if (pair) return pair[0] === id ? 'left' : pair[1] === id ? 'right' : null;
    return variants.comparing.picked.value === id ? 'first' : null;
  }).value;
  const renaming = useComputed(() => variants.renaming.value === id).value;
  const verdict = verdictOf(card);
  const words = verdict.fact
    ? TEXTS.variant(id, card.name, verdict.word, verdict.fact)
    : TEXTS.variantUnread(id, card.name, verdict.word);
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
        variants.comparing.between(id, from);
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
          <span class="blank">{card.scene ? TEXTS.computing : TEXTS.otherRoadUsers}</span>
        )}
      </button>
      {side ? <em class="badge-side">{SIDES[side]}</em> : null}
      <button
        type="button"
        class={`star ${v.starred ? 'on' : ''}`}
        aria-label={TEXTS.starVariant(id)}
        aria-pressed={v.starred}
        title={TEXTS.starS}
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
          aria-label={TEXTS.keepVariant(id)}
          title={TEXTS.keepCtrlD}
          onClick={() => variants.toggleKept(id)}
        >
          {v.kept ? (
            <>
              <Icon name="check" size={12} /> {TEXTS.kept}
            </>
          ) : (
            TEXTS.keep
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
    <b title={TEXTS.doubleClickToRename(card.name)} onDblClick={() => variants.startRenaming(card.id)}>
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
      aria-label={TEXTS.nameOfVariant(card.id)}
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

/** An unchanged default is not a given name. */
const named = (typed: string, { variant, name }: Card): string =>
  variant.called === null && typed.trim() === name ? '' : typed;
