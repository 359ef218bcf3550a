// The strip of variants: one card each, all of them on the clock of the playhead.
import { useRef } from 'preact/hooks';
import { useComputed } from '@preact/signals';
import { perform } from '../../actions/registry';
import { hasEvents, type Card, type Filter } from '../../edit/variants/cards';
import { leftWords } from '../../model/units';
import { MOST_NEW } from '../../model/variants';
import type { Making } from '../../edit/variants/variants';
import { useApp } from '../parts/app-context';
import { ActionButton } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { useAlbum } from './album';
import { CardView } from './card';
import { Range, RangePick } from './range';
import '../../styles/variants.css';
import '../../styles/cases.css';

const FILTERS: readonly (readonly [Filter, string])[] = [
  ['all', 'All'],
  ['events', 'With events'],
  ['starred', 'Starred'],
];

export default function Strip() {
  const c = useApp();
  const { variants } = c;
  const cards = variants.filtered.value;
  const all = variants.cards.value;
  const making = variants.making.value;
  const list = useRef<HTMLDivElement>(null);
  const album = useAlbum(all);
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
    <section class="strip" aria-label="Variants" data-group="variants">
      <header>
        <h2>Variants</h2>
        <About />
        <span class="grow" />
        <div class="seg" role="radiogroup" aria-label="Which variants">
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
        <ActionButton id="compare-variants" size={16}>
          Compare 2
        </ActionButton>
        <ActionButton id="export-variants" class="line" icon="">
          Export all
        </ActionButton>
        <button type="button" class="btn i" aria-label="Close the variants" onClick={() => variants.show(false)}>
          <Icon name="x" size={16} />
        </button>
      </header>
      <Range />
      <div class="cards" ref={list} onKeyDown={walk}>
        {cards.map((card) => (
          <CardView key={card.id} card={card} album={album} />
        ))}
        {Array.from({ length: making ? making.of - making.done : 0 }, (_, i) => (
          <div key={`w${i}`} class="vcard waiting" aria-hidden="true" />
        ))}
        {cards.length || making ? null : <Nobody any={all.length > 0} />}
      </div>
    </section>
  );

  function Nobody({ any }: { any: boolean }) {
    return (
      <p class="none">
        {any ? 'None of them is like that.' : 'No variants yet.'}{' '}
        {any || variants.sweep.value ? null : (
          <button type="button" class="btn pri" onClick={() => perform(c, 'make-variants')}>
            Make {variants.count.value}
          </button>
        )}
      </p>
    );
  }
}

const countOf = (all: readonly Card[], filter: Filter): number =>
  filter === 'all' ? all.length : all.filter((c) => (filter === 'events' ? hasEvents(c) : c.variant.starred)).length;

/** Of whom they are, from which numbers; how far it is while more are made. */
function About() {
  const { editor, variants } = useApp();
  const making = variants.making.value;
  const words = useComputed(() => {
    if (editor.playing.value) return 'all run on one clock';
    const last = variants.cards.value.reduce<Card | null>((a, b) => (a && a.id > b.id ? a : b), null);
    if (!last) return 'ways the scene could go';
    const who = last.state.subject === null ? null : editor.scene.value?.agents.get(last.state.subject)?.name;
    const seed = Math.min(
      ...variants.cards.value.filter((v) => !v.variant.kept && !v.variant.starred).map((v) => v.state.seed),
      last.state.seed,
    );
    const from = `seed ${seed}, diversity ${Math.round(last.state.diversity * 100)}%`;
    return `${who ? `ways of ${who}` : 'everybody anew'}, from ${from}`;
  });
  if (making) return <Progress of={making} />;
  return (
    <>
      <small>{words}</small>
      {variants.sweep.value ? null : (
        <label class="field count">
          <input
            type="number"
            min={1}
            max={MOST_NEW}
            aria-label="How many variants are made"
            value={variants.count.value}
            onChange={(e) => variants.setCount(Number(e.currentTarget.value) || 1)}
          />
          <span>new</span>
        </label>
      )}
      <RangePick />
    </>
  );
}

/** How far it is, what happens in those that are there, and the ways to end it. */
function Progress({ of: m }: { of: Making }) {
  const { variants } = useApp();
  const paused = variants.paused.value;
  const left = paused ? 'waiting' : m.left ? leftWords(m.left) : '';
  return (
    <>
      <small role="status">
        <b>
          {m.done} of {m.of}
        </b>
        {left ? `, ${left}` : ''}
      </small>
      <span class="progress" role="progressbar" aria-label="Made" aria-valuemax={m.of} aria-valuenow={m.done}>
        <i style={{ width: `${(100 * m.done) / m.of}%` }} />
      </span>
      <span class="tally">
        {m.clear ? <em class="tag ok">{m.clear} clear</em> : null}
        {m.near ? <em class="tag near">{m.near} with an event</em> : null}
        {m.hit ? <em class="tag collision">{m.hit} with a collision</em> : null}
      </span>
      <button type="button" class="btn line" onClick={() => variants.pause(!paused)}>
        <Icon name={paused ? 'play' : 'pause'} size={14} />
        {paused ? 'Go on' : 'Pause'}
      </button>
      <button type="button" class="btn line" onClick={() => variants.stop()}>
        Stop{m.done ? `, keep ${m.done}` : ''}
      </button>
    </>
  );
}
