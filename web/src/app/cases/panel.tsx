// The search for a case: the target as a sentence, progress, and results.
import { useRef } from 'preact/hooks';
import { KINDS, type Sought, type What } from '../../model/physics/cases';
import { howWords, KIND_WORDS, momentWords, nothingWords, TITLES } from '../../model/words/case-words';
import { readEvents } from '../../model/words/event-words';
import { MOST_TRIES, type Case, type Cases, type Progress, type SearchState } from '../../edit/tools/cases/cases';
import { PLACE_MORE_M } from '../../model/physics/case-search';
import { accelerationUnit, leftWords, lengthText, lengthUnit, metres, num } from '../../model/base/units';
import { useAlbum } from '../variants/album';
import type { Pictured } from '../../edit/tools/variants/cards';
import { LivePicture } from '../variants/live-picture';
import { useApp } from '../parts/app-context';
import { ActionButton } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { NumberField } from '../parts/number-field';
import '../../styles/variants.css';
import '../../styles/cases.css';
import { TEXTS } from '../../texts/editing/cases';

/** Rendered only while the search is open. */
const useCases = () => useApp().searching.open.value;

export default function CasesPanel() {
  const cases = useCases();
  const nameOf = useName();
  const sought = cases?.sought.value;
  if (!cases || !sought) return null;
  const of = { cases, sought };
  return (
    <>
      <div class="ih">
        <div class="ag t-ink">
          <Icon name="search" size={20} />
        </div>
        <div class="grow">
          <h2>{TITLES[sought.what]}</h2>
          <p>{about(sought, nameOf)}</p>
        </div>
        <button type="button" class="btn i" aria-label={TEXTS.closeTheSearch} onClick={() => cases.close()}>
          <Icon name="x" size={16} />
        </button>
      </div>
      <Sentence {...of} />
      <Run {...of} />
      <Found {...of} />
    </>
  );
}

interface SearchProps {
  readonly cases: Cases;
  readonly sought: Sought;
}

type PartyName = (id: string | null) => string;

function useName(): PartyName {
  const { editor } = useApp();
  const agents = editor.scene.peek()?.agents;
  return (id) => (id === null ? TEXTS.anyRoadUser : (agents?.get(id)?.name ?? TEXTS.aRoadUser));
}

const about = ({ what, who, other }: Sought, nameOf: PartyName): string =>
  KINDS[what].two && other !== null ? TEXTS.betweenAnd(nameOf(who), nameOf(other)) : TEXTS.of(nameOf(who));

function Sentence({ cases, sought }: SearchProps) {
  const nameOf = useName();
  const { two, unit, step, range } = KINDS[sought.what];
  const may = cases.may.value;
  return (
    <section class="sect seek" aria-label={TEXTS.searchFor}>
      <p>
        <select
          class="field pick"
          aria-label={TEXTS.searchFor}
          value={sought.what}
          onChange={(e) => cases.setKind(e.currentTarget.value as What)}
        >
          {(Object.keys(KIND_WORDS) as What[]).map((k) => (
            <option key={k} value={k}>
              {KIND_WORDS[k]}
            </option>
          ))}
        </select>
      </p>
      <p>
        <span>{sought.what === 'first' ? '' : two ? TEXTS.between : TEXTS.ofWord}</span>
        <b class="who">{nameOf(sought.who)}</b>
        {two || sought.other !== null ? (
          <>
            <span>{sought.what === 'first' ? TEXTS.before : TEXTS.and}</span>
            <b class="who">{nameOf(sought.other)}</b>
          </>
        ) : null}
        {sought.other === null ? null : (
          <button
            type="button"
            class="btn i"
            aria-label={TEXTS.varyInsteadOf(nameOf(sought.other), nameOf(sought.who))}
            title={TEXTS.varyTheOther}
            onClick={() => cases.swap()}
          >
            <Icon name="swap" size={15} />
          </button>
        )}
      </p>
      {step ? (
        <p>
          <span>{sought.what === 'braking' ? TEXTS.atLeast : TEXTS.under}</span>
          <NumberField
            key={sought.what}
            label={TEXTS.limit}
            field="limit"
            unit={() => (unit === 'm' ? lengthUnit() : unit === 's' ? unit : accelerationUnit())}
            quantity={() => (unit === 'm' ? 'length' : unit === 's' ? 'time' : 'acceleration')}
            step={step}
            value={() => cases.sought.value?.limit ?? null}
            text={() => (unit === 's' ? num : lengthText)(cases.sought.value?.limit ?? 0, 1)}
            range={() => range}
            set={(limit) => cases.seek({ ...sought, limit })}
          />
        </p>
      ) : null}
      <p role="group" aria-label={TEXTS.whatMayVary(nameOf(sought.who))}>
        <span>{TEXTS.mayVary}</span>
        {(
          [
            ['speed', TEXTS.startSpeed],
            ['time', TEXTS.goalTime],
            ['seed', TEXTS.seed],
            ['place', TEXTS.positionWithin(metres(PLACE_MORE_M, 0))],
          ] as const
        ).map(([k, words]) => (
          <button
            key={k}
            type="button"
            class={`pillb ${may[k] ? 'on' : ''}`}
            aria-pressed={may[k]}
            onClick={() => cases.toggleMay(k)}
          >
            {words}
          </button>
        ))}
      </p>
    </section>
  );
}

function stateWords(state: SearchState, { tried, of, left }: Progress): string {
  if (state === 'running') return left === null ? '' : leftWords(left);
  if (state === 'paused') return TEXTS.paused;
  return tried < of ? TEXTS.enough : '';
}

function Run({ cases, sought }: SearchProps) {
  const state = cases.state.value;
  const obstacle = cases.obstacle.value;
  const p = cases.progress.value;
  const problem = cases.problem.value;
  const found = cases.found.value.length;
  if (state === 'ready')
    return (
      <section class="sect">
        {obstacle ? <p class="note">{obstacle}</p> : null}
        <ActionButton id="case-search" class="pri wide" icon="search" size={16} />
      </section>
    );
  return (
    <section class="sect seeking" aria-label={TEXTS.searchProgress}>
      <h3>
        <span role="status">{TEXTS.ofTried(p.tried, p.of)}</span>
        <small>{stateWords(state, p)}</small>
      </h3>
      <div class="progress" role="progressbar" aria-label={TEXTS.tried} aria-valuemax={p.of} aria-valuenow={p.tried}>
        <i style={{ width: `${(100 * p.tried) / p.of}%` }} />
      </div>
      <p class="tally">
        <em class={`tag ${p.found ? 'near' : ''}`}>{TEXTS.found(p.found)}</em>
        {p.collisions ? <em class="tag collision">{TEXTS.collided(p.collisions)}</em> : null}
        <em class="tag ok">{TEXTS.without(Math.max(0, p.tried - p.found - p.collisions))}</em>
      </p>
      {problem ? (
        <p class="problem" role="alert">
          <Icon name="warn" size={15} /> {problem}
        </p>
      ) : null}
      <div class="row">
        {found ? (
          <ActionButton id="cases-keep" class="pri" icon="">
            {state === 'running' ? TEXTS.stopAndKeep(found) : TEXTS.keepAsVariants(found)}
          </ActionButton>
        ) : null}
        {state === 'running' ? (
          <ActionButton key="stop" id="case-stop" class="line" size={15} />
        ) : (
          <ActionButton key="on" id="case-search" class="line" icon="">
            {state === 'paused' ? TEXTS.resume : TEXTS.tryMore(MOST_TRIES)}
          </ActionButton>
        )}
      </div>
      <AsItWas cases={cases} />
      {state === 'done' && !p.found ? <Nothing cases={cases} sought={sought} tried={p.tried} /> : null}
    </section>
  );
}

const clock = (d: Date): string => d.toLocaleTimeString([], { hour: '2-digit', minute: '2-digit' });

function AsItWas({ cases }: Pick<SearchProps, 'cases'>) {
  const from = cases.from.value;
  if (!from) return null;
  const words = cases.outdated.value ? TEXTS.youHaveChanged(clock(from.at)) : TEXTS.youCanKeepEditing(clock(from.at));
  return <p class="note">{words}</p>;
}

function Nothing({ cases, sought, tried }: SearchProps & { tried: number }) {
  const nearest = cases.closest.value;
  const may = cases.may.value;
  return (
    <>
      <p role="status">{nothingWords(sought, tried, nearest?.moment ?? null)}</p>
      <div class="stack">
        {may.time ? null : (
          <button type="button" class="opt" onClick={() => cases.toggleMay('time')}>
            {TEXTS.varyGoalTime}
          </button>
        )}
        {may.place ? null : (
          <button type="button" class="opt" onClick={() => cases.toggleMay('place')}>
            {TEXTS.varyPosition}
          </button>
        )}
        {may.speed ? null : (
          <button type="button" class="opt" onClick={() => cases.toggleMay('speed')}>
            {TEXTS.varyStartSpeed}
          </button>
        )}
        {nearest ? (
          <button type="button" class="opt" onClick={() => cases.take(nearest)}>
            {TEXTS.useTheClosest}
          </button>
        ) : null}
      </div>
    </>
  );
}

const ORDER: Partial<Record<What, string>> = { braking: TEXTS.hardestFirst, red: TEXTS.fastestFirst };

function Found({ cases, sought }: SearchProps) {
  const all = cases.found.value;
  const list = useRef<HTMLDivElement>(null);
  const pictures = all.map((c) => pictureOf(c, sought));
  const album = useAlbum(pictures);
  if (!all.length) return null;
  const walk = (e: KeyboardEvent) => {
    const step = e.key === 'ArrowDown' ? 1 : e.key === 'ArrowUp' ? -1 : 0;
    if (!step) return;
    e.preventDefault();
    e.stopPropagation();
    cases.walk(step);
    list.current?.querySelector<HTMLElement>(`[data-case="${cases.shown.peek()}"] .face`)?.focus();
  };
  return (
    <section class="sect last" aria-label={TEXTS.casesFoundList}>
      <h3>
        {TEXTS.foundTitle}
        <small>{ORDER[sought.what] ?? TEXTS.closestFirst}</small>
      </h3>
      <div class="cases" ref={list} onKeyDown={walk}>
        {all.map((c, i) => (
          <article key={c.id} class={`case ${cases.shown.value === c.id ? 'on' : ''}`} data-case={c.id}>
            <button
              type="button"
              class="face"
              data-plays
              aria-pressed={cases.shown.value === c.id}
              onClick={() => cases.show(cases.shown.peek() === c.id ? null : c.id)}
            >
              <LivePicture card={pictures[i]} album={album} />
              <Words found={c} sought={sought} />
            </button>
            <span class="does">
              <button
                type="button"
                class={`btn i star ${c.starred ? 'on' : ''}`}
                aria-label={TEXTS.starCase(c.id)}
                aria-pressed={c.starred}
                title={TEXTS.starS}
                onClick={() => cases.toggleStar(c.id)}
              >
                <Icon name="star" size={15} />
              </button>
              <button
                type="button"
                class="btn line"
                aria-label={TEXTS.useCase(c.id)}
                title={TEXTS.replacesTheScene}
                onClick={() => cases.take(c)}
              >
                {TEXTS.use}
              </button>
            </span>
          </article>
        ))}
      </div>
    </section>
  );
}

function Words({ found: { id, take, moment, like }, sought }: { found: Case; sought: Sought }) {
  const { editor } = useApp();
  const a = take.scene.agents.get(sought.who)!;
  const from = useCases()?.from.value?.scene.agents.get(sought.who);
  return (
    <span class="words">
      <span>{TEXTS.case(id)}</span>
      <b>{momentWords(sought, moment)}</b>
      {howWords(a, take.scene, moment, editor.view.unitOf(a), from).map((words) => (
        <small key={words}>{words}</small>
      ))}
      {like ? <small>{TEXTS.andSimilar(like)}</small> : null}
    </span>
  );
}

const pictureOf = ({ take }: Case, { who }: Sought): Pictured => ({
  scene: take.scene,
  set: take.set,
  events: readEvents(take.scene, take.set),
  state: { subject: who },
});
