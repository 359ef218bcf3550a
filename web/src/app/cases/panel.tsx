// The search for a case: the sentence of what is looked for, how far it is, and what was found.
import { useRef } from 'preact/hooks';
import { KINDS, type Sought, type What } from '../../model/cases';
import { howWords, KIND_WORDS, momentWords, nothingWords, TITLES } from '../../model/case-words';
import { readEvents } from '../../model/events';
import { MOST_TRIES, type Case, type Cases } from '../../edit/cases/cases';
import { leftWords, num } from '../../model/units';
import { useAlbum } from '../variants/album';
import { LivePicture, type Pictured } from '../variants/live-picture';
import { useApp } from '../parts/app-context';
import { ActionButton } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { NumberField } from '../parts/number-field';
import '../../styles/variants.css';
import '../../styles/cases.css';

/** Shown while the search is open alone. */
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
        <button type="button" class="btn i" aria-label="Close the search" onClick={() => cases.close()}>
          <Icon name="x" size={16} />
        </button>
      </div>
      <Sentence {...of} />
      <Run {...of} />
      <Found {...of} />
    </>
  );
}

interface Of {
  readonly cases: Cases;
  readonly sought: Sought;
}

type NameOf = (id: string | null) => string;

function useName(): NameOf {
  const { editor } = useApp();
  const agents = editor.scene.peek()?.agents;
  return (id) => (id === null ? 'anybody' : (agents?.get(id)?.name ?? 'somebody'));
}

const about = ({ what, who, other }: Sought, nameOf: NameOf): string =>
  KINDS[what].two && other !== null ? `between ${nameOf(who)} and ${nameOf(other)}` : `of ${nameOf(who)}`;

function Sentence({ cases, sought }: Of) {
  const nameOf = useName();
  const { two, unit, step, range } = KINDS[sought.what];
  const may = cases.may.value;
  return (
    <section class="sect seek" aria-label="What is looked for">
      <p>
        <select
          class="field pick"
          aria-label="What is looked for"
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
        <span>{sought.what === 'first' ? '' : two ? 'between' : 'of'}</span>
        <b class="who">{nameOf(sought.who)}</b>
        {two || sought.other !== null ? (
          <>
            <span>{sought.what === 'first' ? 'before' : 'and'}</span>
            <b class="who">{nameOf(sought.other)}</b>
          </>
        ) : null}
        {sought.other === null ? null : (
          <button
            type="button"
            class="btn i"
            aria-label={`Try ${nameOf(sought.other)} in place of ${nameOf(sought.who)}`}
            title="The other one is tried"
            onClick={() => cases.swap()}
          >
            <Icon name="swap" size={15} />
          </button>
        )}
      </p>
      {step ? (
        <p>
          <span>{sought.what === 'braking' ? 'at least' : 'under'}</span>
          <NumberField
            key={sought.what}
            label="Limit"
            field="limit"
            unit={() => unit}
            quantity={() => (unit === 'm' ? 'length' : unit === 's' ? 'time' : 'count')}
            step={step}
            value={() => cases.sought.value?.limit ?? null}
            text={() => num(cases.sought.value?.limit ?? 0, 1)}
            range={() => range}
            set={(limit) => cases.seek({ ...sought, limit })}
          />
        </p>
      ) : null}
      <p role="group" aria-label={`What of ${nameOf(sought.who)} may change`}>
        <span>may change</span>
        {(
          [
            ['speed', 'start speed'],
            ['time', 'goal time'],
            ['seed', 'seed'],
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

function Run({ cases, sought }: Of) {
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
    <section class="sect seeking" aria-label="How far the search is">
      <h3>
        <span role="status">
          {p.tried} of {p.of} tried
        </span>
        <small>{state === 'running' && p.left !== null ? leftWords(p.left) : state === 'paused' ? 'paused' : ''}</small>
      </h3>
      <div class="progress" role="progressbar" aria-label="Tried" aria-valuemax={p.of} aria-valuenow={p.tried}>
        <i style={{ width: `${(100 * p.tried) / p.of}%` }} />
      </div>
      <p class="tally">
        <em class={`tag ${p.found ? 'near' : ''}`}>{p.found} found</em>
        {p.collisions ? <em class="tag collision">{p.collisions} collided</em> : null}
        <em class="tag ok">{Math.max(0, p.tried - p.found - p.collisions)} not like that</em>
      </p>
      {problem ? (
        <p class="problem" role="alert">
          <Icon name="warn" size={15} /> {problem}
        </p>
      ) : null}
      <div class="row">
        {found ? (
          <ActionButton id="cases-keep" class="pri" icon="">
            {state === 'running' ? `Stop and keep ${found}` : `Keep ${found === 1 ? 'it' : `the ${found}`} as variants`}
          </ActionButton>
        ) : null}
        {state === 'running' ? (
          <ActionButton key="stop" id="case-stop" class="line" size={15} />
        ) : (
          <ActionButton key="on" id="case-search" class="line" icon="">
            {state === 'paused' ? 'Go on' : `Try ${MOST_TRIES} more`}
          </ActionButton>
        )}
      </div>
      <AsItWas cases={cases} />
      {state === 'done' && !p.found ? <Nothing cases={cases} sought={sought} tried={p.tried} /> : null}
    </section>
  );
}

const clock = (d: Date): string => d.toLocaleTimeString([], { hour: '2-digit', minute: '2-digit' });

function AsItWas({ cases }: Pick<Of, 'cases'>) {
  const from = cases.from.value;
  if (!from) return null;
  const words = cases.outdated.value
    ? `You have changed the scene since. A case brings back the scene of ${clock(from.at)}.`
    : `You can keep editing: the search uses the scene as it was at ${clock(from.at)}.`;
  return <p class="note">{words}</p>;
}

function Nothing({ cases, sought, tried }: Of & { tried: number }) {
  const nearest = cases.closest.value;
  const may = cases.may.value;
  return (
    <>
      <p role="status">{nothingWords(sought, tried, nearest?.moment ?? null)}</p>
      <div class="stack">
        {may.time ? null : (
          <button type="button" class="opt" onClick={() => cases.toggleMay('time')}>
            Let goal time change too
          </button>
        )}
        {may.speed ? null : (
          <button type="button" class="opt" onClick={() => cases.toggleMay('speed')}>
            Let start speed change too
          </button>
        )}
        {nearest ? (
          <button type="button" class="opt" onClick={() => cases.take(nearest)}>
            Take the nearest
          </button>
        ) : null}
      </div>
    </>
  );
}

function Found({ cases, sought }: Of) {
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
    <section class="sect last" aria-label="Cases that were found">
      <h3>
        Found
        <small>{sought.what === 'braking' ? 'hardest first' : 'closest first'}</small>
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
                aria-label={`Star case ${c.id}`}
                aria-pressed={c.starred}
                title="Star (S)"
                onClick={() => cases.toggleStar(c.id)}
              >
                <Icon name="star" size={15} />
              </button>
              <button
                type="button"
                class="btn line"
                aria-label={`Take case ${c.id}`}
                title="It is what happens from now on; one step, that can be undone"
                onClick={() => cases.take(c)}
              >
                Take
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
  return (
    <span class="words">
      <span>Case {id}</span>
      <b>{momentWords(sought, moment)}</b>
      {howWords(a, take.scene, moment, editor.unitOf(a)).map((words) => (
        <small key={words}>{words}</small>
      ))}
      {like ? <small>and {like} like it</small> : null}
    </span>
  );
}

const pictureOf = ({ take }: Case, { who }: Sought): Pictured => ({
  scene: take.scene,
  set: take.set,
  events: readEvents(take.scene, take.set),
  state: { subject: who },
});
