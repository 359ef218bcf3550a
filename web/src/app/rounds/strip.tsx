// A round: six futures of one road user as cards, or six scenes, each to be kept or rejected.
import { useMemo } from 'preact/hooks';
import { choose } from '../../model/document/commands';
import type { Scene } from '../../model/document/scene';
import type { MotionSet } from '../../model/document/futures';
import { readEvents } from '../../model/words/event-words';
import type { Hand } from '../../edit/tools/rounds/deck';
import { useAlbum } from '../variants/album';
import type { Pictured } from '../../edit/tools/variants/cards';
import { useApp } from '../parts/app-context';
import { ActionButton, KeyCaps, Segments } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { CardView } from './card';
import '../../styles/variants.css';
import '../../styles/rounds.css';
import { isSure } from './sure';
import { TEXTS } from '../../texts/panels/rounds-panel';

/** Subject of the cards. */
const WHOSE = [
  ['rounds-one', TEXTS.thisRoadUser],
  ['rounds-scene', TEXTS.wholeScene],
] as const;

/** Number of rounds shown as dots from the start. */
const USUAL_ROUNDS = 5;

export default function RoundStrip() {
  const c = useApp();
  const { rounds, deck } = c;
  const hand = deck.hand.value;
  const problem = deck.problem.value;
  const asking = deck.asking.value;
  return (
    <section
      class={`strip rounds ${asking ? 'asking' : ''}`}
      aria-label={TEXTS.roundTitle}
      data-group="rounds"
      aria-busy={asking}
    >
      <header>
        <Title />
        <span class="grow" />
        <Counts />
        <Keep />
        <ActionButton id="round-stop" class="line" />
        <ActionButton id="round-next" class="pri" icon="" withKey />
      </header>
      {hand ? (
        <Cards hand={hand} />
      ) : (
        <div class="cards">{problem ? null : <p class="none">{TEXTS.generatingSix}</p>}</div>
      )}
      {problem ? (
        <p class="problem" role="alert">
          <Icon name="warn" size={15} />
          {problem}
          <button type="button" class="btn line" onClick={() => rounds.tryAgain()}>
            {TEXTS.tryAgain}
          </button>
        </p>
      ) : (
        <Learnt />
      )}
    </section>
  );
}

function Title() {
  const { rounds, deck } = useApp();
  const round = rounds.asked.value?.round ?? 1;
  const subject = rounds.subject.value;
  const asking = deck.asking.value;
  const all = Math.max(USUAL_ROUNDS, round);
  const n = deck.hand.value?.names.length;
  const many = n === 6 || !n ? TEXTS.six : n;
  const what = subject?.id === null ? TEXTS.futuresOfTheScene(many) : TEXTS.futuresOf(many, subject?.name ?? '');
  return (
    <>
      <h2>{TEXTS.roundOpened(round)}</h2>
      <Segments label={TEXTS.roundsFor} items={WHOSE} />
      <span class="dots" role="img" aria-label={TEXTS.roundOpened(round)}>
        {Array.from({ length: all }, (_, i) => (
          <i key={i} class={i + 1 < round ? 'done' : i + 1 === round ? 'now' : ''} />
        ))}
      </span>
      <small role="status">{asking ? TEXTS.generating : round === 1 ? what : TEXTS.basedOnYourAnswers(what)}</small>
    </>
  );
}

function Counts() {
  const { rounds } = useApp();
  const said = rounds.said.value;
  const of = (v: string | undefined) => said.filter((s) => s?.verdict === v).length;
  return (
    <span class="counts">
      <em class="tag ok">{TEXTS.countKept(of('keep'))}</em>
      <em class="tag no">{TEXTS.countRejected(of('reject'))}</em>
      <em class="tag">{TEXTS.countOpen(of(undefined))}</em>
    </span>
  );
}

function Keep() {
  const { rounds } = useApp();
  const n = rounds.said.value.filter((s) => s?.verdict === 'keep').length;
  return n ? (
    <ActionButton id="round-variants" class="line" icon="">
      {TEXTS.keepAsVariants(n)}
    </ActionButton>
  ) : null;
}

function Cards({ hand }: { hand: Hand }) {
  const { editor } = useApp();
  const motion = editor.answers.motion.value;
  const pictures = useMemo(() => picturesOf(editor.scene.peek()!, motion, hand), [hand, motion]);
  const album = useAlbum(pictures);
  return (
    <div class="cards">
      {pictures.map((p, i) => (
        <CardView key={i} hand={hand} index={i} picture={p} album={album} />
      ))}
    </div>
  );
}

/** The scene with each card in turn; for one road user's cards, the others move as now. */
function picturesOf(scene: Scene, motion: MotionSet, hand: Hand): Pictured[] {
  if (hand.id === null)
    return hand.sets.map((set) => ({ scene, set, events: readEvents(scene, set), state: { subject: null } }));
  const { id, futures } = hand;
  const set: MotionSet = {
    ...motion,
    futures: new Map(motion.futures).set(id, futures),
    driving: new Set([...motion.driving, id]),
  };
  const a = scene.agents.get(id)!;
  return futures.modes.map((_, i) => ({
    scene: choose(a, i, '').apply(scene),
    set,
    events: [],
    state: { subject: id },
  }));
}

function Learnt() {
  const { rounds } = useApp();
  const wished = rounds.wished.value;
  const sure = wished.filter(isSure);
  const all = sure.length ? sure : wished;
  return (
    <footer>
      <span class="lab">{TEXTS.learnt}</span>
      <span class="chips">
        {all.map((w) => (
          <span key={w.words} class={`wish ${w.learned ? '' : 'own'}`}>
            {w.words}
            <button
              type="button"
              aria-label={TEXTS.removeOne(w.words)}
              title={TEXTS.removeTitle}
              onClick={() => rounds.forget(w)}
            >
              <Icon name="x" size={11} />
            </button>
          </span>
        ))}
        {all.length ? null : <small>{TEXTS.threeMustAgree}</small>}
      </span>
      <span class="hints" aria-hidden="true">
        <KeyCaps of="K" /> {TEXTS.orPullUpKeep} <KeyCaps of="J" /> {TEXTS.orDownReject} <KeyCaps of="Right" />{' '}
        {TEXTS.nextCard}
      </span>
    </footer>
  );
}
