// Learned preferences: each with its evidence, and contradicting verdicts.
import { earlierAnswers, type CardVerdict } from '../../model/document/feedback';
import type { Subject } from '../../model/document/feedback-commands';
import { againstWords, restsOn, wishes, wishKey } from '../../model/words/feedback-words';
import { nameIn } from '../../model/document/scene';
import type { Editor } from '../../edit/session/editor';
import type { Wished } from '../../edit/tools/rounds/rounds';
import type { SpeedUnit } from '../../model/base/units';
import { useApp } from '../parts/app-context';
import { ActionButton } from '../parts/buttons';
import { Icon } from '../parts/icons';
import '../../styles/rounds.css';
import { capitalised } from '../../texts/language';
import { isSure } from './sure';
import { TEXTS } from '../../texts/panels/rounds-panel';

export default function RoundsPanel() {
  const { rounds } = useApp();
  const a = rounds.subject.value;
  if (!a) return null;
  const answers = a.feedback?.answers ?? [];
  return (
    <>
      <div class="ih">
        <div class="ag t-ink">
          <Icon name="star" size={20} />
        </div>
        <div class="grow">
          <h2>{TEXTS.preferences}</h2>
          <p>
            {capitalised(a.name)}, {TEXTS.answers(answers.length)}
          </p>
        </div>
        <button type="button" class="btn i" aria-label={TEXTS.closeTheRounds} onClick={() => rounds.close()}>
          <Icon name="x" size={16} />
        </button>
      </div>
      <RoundList subject={a} />
      <Wishes subject={a} />
      <Apart subject={a} />
      <div class="grow" />
      <footer class="sect foot">
        <ActionButton id="round-table" class="line" icon="" />
        <button type="button" class="btn line" onClick={() => rounds.forgetAll()}>
          {TEXTS.removeAll}
        </button>
      </footer>
    </>
  );
}

interface RoundProps {
  readonly subject: Subject;
}

/** For whole-scene cards speeds use the unit of vehicles. */
function unitFor(e: Editor, { id }: Subject): SpeedUnit {
  const a = id === null ? undefined : e.scene.value?.agents.get(id);
  return a ? e.view.unitOf(a) : e.view.speedUnit.value;
}

const percent = (v: number): string => `${Math.round(v * 100)}%`;

function RoundList({ subject }: RoundProps) {
  const { rounds, deck } = useApp();
  const now = rounds.asked.value?.round ?? 1;
  const answers = subject.feedback?.answers ?? [];
  const done = new Set([...answers.map((x) => x.round), now]);
  const hand = deck.hand.value;
  const matches = hand?.asked.round === now ? hand.round.cards.flatMap((x) => x.match ?? []) : [];
  return (
    <section class="sect roundlist">
      <h3>
        {TEXTS.rounds}
        {matches.length ? <small>{TEXTS.bestMatch}</small> : null}
      </h3>
      {[...done]
        .sort((x, y) => x - y)
        .map((n) => (
          <p key={n} aria-current={n === now ? 'step' : undefined}>
            <b>{TEXTS.round(n)}</b>
            <span>{countWords(answers.filter((x) => x.round === n))}</span>
            <em>{n === now && matches.length ? percent(Math.max(...matches)) : ''}</em>
          </p>
        ))}
    </section>
  );
}

function countWords(of: readonly CardVerdict[]): string {
  const kept = of.filter((x) => x.verdict === 'keep').length;
  return of.length ? TEXTS.keptRejected(kept, of.length - kept) : TEXTS.noAnswersYet;
}

function Wishes({ subject }: RoundProps) {
  const { rounds } = useApp();
  const all = rounds.wished.value;
  const unsure = all.filter((w) => !isSure(w));
  const rows = (of: readonly Wished[]) => of.map((w) => <WishRow key={wishKey(w.wish)} wished={w} subject={subject} />);
  return (
    <section class="sect wishes">
      <h3>
        {TEXTS.learnedPreferences}
        {all.some((w) => w.learned) ? <small>{TEXTS.strength}</small> : null}
      </h3>
      {rows(all.filter(isSure))}
      {unsure.length ? (
        <details>
          <summary>{TEXTS.weakOnes(unsure.length)}</summary>
          {rows(unsure)}
        </details>
      ) : null}
      {all.length ? null : <p class="mut">{TEXTS.noneYetTheyCome}</p>}
      <AddWish />
    </section>
  );
}

function WishRow({ wished, subject }: RoundProps & { wished: Wished }) {
  const { editor, rounds, deck } = useApp();
  const { words, learned } = wished;
  const scene = editor.scene.value!;
  const hand = deck.hand.value;
  const answers = hand ? earlierAnswers(subject.feedback, hand.asked) : [];
  const rests = learned
    ? restsOn(learned, answers, { nameOf: nameIn(scene), unit: unitFor(editor, subject) })
    : TEXTS.addedByYou;
  return (
    <div class="wishrow" data-wish={words}>
      <b>{words}</b>
      {learned ? <em>{percent(learned.strength)}</em> : null}
      <button type="button" class="btn i" aria-label={TEXTS.removeOne(words)} onClick={() => rounds.forget(wished)}>
        <Icon name="x" size={13} />
      </button>
      {learned ? (
        <span class="bar" role="img" aria-label={TEXTS.strengthIs(percent(learned.strength))}>
          <i style={{ width: percent(learned.strength) }} />
        </span>
      ) : null}
      <p>{rests}</p>
    </div>
  );
}

function AddWish() {
  const { editor, rounds, deck } = useApp();
  const hand = deck.hand.value;
  const scene = editor.scene.value;
  if (!hand || !scene) return null;
  const known = new Set(rounds.wished.value.map((w) => wishKey(w.wish)));
  const features = hand.round.cards.map((card) => card.features);
  const all = wishes(hand.id, features, nameIn(scene)).filter((w) => !known.has(w.key));
  return (
    <select
      class="field pick"
      aria-label={TEXTS.addAPreference}
      value=""
      onChange={(e) => {
        const wish = all.find((w) => w.key === e.currentTarget.value)?.wish;
        e.currentTarget.selectedIndex = 0;
        e.currentTarget.blur();
        if (wish) rounds.wish(wish);
      }}
    >
      <option value="">{TEXTS.addAPreference}</option>
      {all.map((w) => (
        <option key={w.key} value={w.key}>
          {w.words}
        </option>
      ))}
    </select>
  );
}

/** Further contradictions are counted. */
const MOST_NAMED = 3;

function Apart({ subject }: RoundProps) {
  const { rounds, deck } = useApp();
  const hand = deck.hand.value;
  if (!hand) return null;
  const answers = earlierAnswers(subject.feedback, hand.asked);
  const torn = rounds.wished.value.filter(isSure).flatMap((w) => {
    const against = (w.learned?.against ?? []).flatMap((i) => answers[i] ?? []);
    return against.length ? [{ w, against }] : [];
  });
  if (!torn.length) return null;
  return (
    <section class="sect apart">
      <h3>{TEXTS.conflicts}</h3>
      {torn.map(({ w, against }) => (
        <p key={w.words}>
          <b>{w.words}:</b> {against.slice(0, MOST_NAMED).map(againstWords).join(' ')}
          {against.length > MOST_NAMED ? TEXTS.andMore(against.length - MOST_NAMED) : ''}
        </p>
      ))}
    </section>
  );
}
