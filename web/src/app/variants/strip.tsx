// The strip of variants: one card each, all at the playhead's time.
import { useRef } from 'preact/hooks';
import { useComputed } from '@preact/signals';
import { perform } from '../../actions/registry';
import { hasEvents, type Card, type VariantFilter, type Pictured } from '../../edit/tools/variants/cards';
import { leftWords } from '../../model/base/units';
import { MOST_NEW } from '../../model/document/variants';
import type { Making } from '../../edit/tools/variants/making';
import { useApp } from '../parts/app-context';
import { ActionButton } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { useAlbum } from './album';
import { CardView, verdictOf } from './card';
import { LivePicture, type Album } from './live-picture';
import { Range, RangePick } from './range';
import '../../styles/variants.css';
import { TEXTS } from '../../texts/panels/variants-panel';
import '../../styles/cases.css';

const FILTERS: readonly (readonly [VariantFilter, string])[] = [
  ['all', TEXTS.all],
  ['events', TEXTS.withEvents],
  ['starred', TEXTS.starred],
];

export default function Strip() {
  const c = useApp();
  const { variants } = c;
  const cards = variants.filtered.value;
  const all = variants.cards.value;
  const making = variants.making.value;
  const list = useRef<HTMLDivElement>(null);
  const album = useAlbum([...all, ...(making?.made ?? [])]);
  const walk = (e: KeyboardEvent) => {
    const step = e.key === 'ArrowRight' ? 1 : e.key === 'ArrowLeft' ? -1 : 0;
    if (!step || (e.target as HTMLElement).tagName === 'INPUT') return;
    e.preventDefault();
    e.stopPropagation();
    const at = cards.findIndex((card) => card.id === variants.current.peek());
    const next = cards[Math.min(cards.length - 1, Math.max(0, at + step))];
    if (next) list.current?.querySelector<HTMLElement>(`[data-variant="${next.id}"] .face`)?.focus();
  };
  return (
    <section class="strip" aria-label={TEXTS.variants} data-group="variants">
      <header>
        <h2>{TEXTS.variants}</h2>
        <About />
        <span class="grow" />
        {making ? null : (
          <div class="seg" role="radiogroup" aria-label={TEXTS.whichVariants}>
            {FILTERS.map(([id, text]) => (
              <button
                key={id}
                type="button"
                role="radio"
                aria-checked={variants.filter.value === id}
                class={`btn ${variants.filter.value === id ? 'on' : ''}`}
                onClick={() => variants.setFilter(id)}
              >
                {text} {countOf(all, id)}
              </button>
            ))}
          </div>
        )}
        <ActionButton id="compare-variants" size={16}>
          {TEXTS.compareTwo}
        </ActionButton>
        <ActionButton id="export-variants" class="line" icon="">
          {TEXTS.exportAll}
        </ActionButton>
        <button type="button" class="btn i" aria-label={TEXTS.closeTheVariants} onClick={() => variants.show(false)}>
          <Icon name="x" size={16} />
        </button>
      </header>
      <Range />
      <div class="cards" ref={list} onKeyDown={walk}>
        {cards.map((card) => (
          <CardView key={card.id} card={card} album={album} />
        ))}
        {Array.from({ length: making?.of ?? 0 }, (_, i) => (
          <Arriving key={`w${i}`} one={making!.made[i]} album={album} />
        ))}
        {cards.length || making ? null : <Nobody any={all.length > 0} />}
      </div>
    </section>
  );

  function Nobody({ any }: { any: boolean }) {
    return (
      <p class="none">
        {any ? TEXTS.noMatches : TEXTS.noVariantsYet}{' '}
        {any || variants.range.sweep.value ? null : (
          <button type="button" class="btn pri" onClick={() => perform(c, 'make-variants')}>
            {TEXTS.make(variants.count.value)}
          </button>
        )}
      </p>
    );
  }
}

/** A place for a variant being made: its known part is shown, and it can be taken once all are done. */
function Arriving({ one, album }: { one: Pictured | undefined; album: Album }) {
  if (!one) return <div class="vcard waiting" aria-hidden="true" />;
  const { colour, word, fact } = verdictOf(one);
  return (
    <div class="vcard arrived">
      <LivePicture card={one} album={album} />
      {/* Names tell them apart: they come when all are known. */}
      <div class="named">{'\u00a0'}</div>
      <div class="verdict">
        <span class={`tag ${colour}`}>{word}</span>
        <small>{fact}</small>
      </div>
    </div>
  );
}

const countOf = (all: readonly Card[], filter: VariantFilter): number =>
  filter === 'all' ? all.length : all.filter((c) => (filter === 'events' ? hasEvents(c) : c.variant.starred)).length;

/** Subject and numbers; progress while more are made. */
function About() {
  const { editor, variants } = useApp();
  const making = variants.making.value;
  const words = useComputed(() => {
    if (editor.playhead.playing.value) return TEXTS.allRunOnOneClock;
    const last = variants.cards.value.reduce<Card | null>((a, b) => (a && a.id > b.id ? a : b), null);
    if (!last) return TEXTS.futuresOfTheScene;
    const who = last.state.subject === null ? null : editor.scene.value?.agents.get(last.state.subject)?.name;
    const seed = Math.min(
      ...variants.cards.value.filter((v) => !v.variant.kept && !v.variant.starred).map((v) => v.state.seed),
      last.state.seed,
    );
    const from = TEXTS.seedDiversity(seed, Math.round(last.state.diversity * 100));
    return who ? TEXTS.futuresOf(who, from) : TEXTS.allRoadUsers(from);
  });
  if (making) return <Progress of={making} />;
  return (
    <>
      <small>{words}</small>
      {variants.range.sweep.value ? null : (
        <label class="field count">
          <input
            type="number"
            min={1}
            max={MOST_NEW}
            aria-label={TEXTS.numberOfVariants}
            value={variants.count.value}
            onChange={(e) => variants.setCount(Number(e.currentTarget.value) || 1)}
          />
          <span>{TEXTS.new}</span>
        </label>
      )}
      <RangePick />
    </>
  );
}

/** Progress, events so far, and buttons to end it. */
function Progress({ of: m }: { of: Making }) {
  const { variants } = useApp();
  const paused = variants.paused.value;
  const left = paused ? TEXTS.paused : m.left ? leftWords(m.left) : '';
  return (
    <>
      {/* They come first: what is behind them grows, and they stay under the pointer. */}
      <button type="button" class="btn line" onClick={() => variants.pause(!paused)}>
        <Icon name={paused ? 'play' : 'pause'} size={14} />
        {paused ? TEXTS.resume : TEXTS.pause}
      </button>
      <button type="button" class="btn line" onClick={() => variants.stop()}>
        {m.made.length ? TEXTS.stopKeep(m.made.length) : TEXTS.stop}
      </button>
      <small role="status">
        <b>{TEXTS.of(m.made.length, m.of)}</b>
        {left ? `, ${left}` : ''}
      </small>
      <span
        class="progress"
        role="progressbar"
        aria-label={TEXTS.progress}
        aria-valuemax={m.of}
        aria-valuenow={m.made.length}
      >
        <i style={{ width: `${(100 * m.made.length) / m.of}%` }} />
      </span>
      <span class="tally">
        {m.clear ? <em class="tag ok">{TEXTS.withoutConflict(m.clear)}</em> : null}
        {m.near ? <em class="tag near">{TEXTS.withAnEvent(m.near)}</em> : null}
        {m.hit ? <em class="tag collision">{TEXTS.withACollision(m.hit)}</em> : null}
      </span>
    </>
  );
}
