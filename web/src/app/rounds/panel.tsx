// What was learned from rounds: wishes with what they rest on, and where answers pull apart.
import { earlierAnswers, type Answer, type Subject } from '../../model/feedback';
import { againstWords, restsOn, wishes, wishKey } from '../../model/feedback-words';
import { nameIn } from '../../model/scene';
import type { Editor } from '../../edit/editor';
import type { Wished } from '../../edit/rounds/rounds';
import type { SpeedUnit } from '../../model/units';
import { useApp } from '../parts/app-context';
import { ActionButton } from '../parts/buttons';
import { Icon } from '../parts/icons';
import '../../styles/rounds.css';

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
          <h2>What you like</h2>
          <p>
            {upper(a.name)}, {answers.length === 1 ? '1 answer' : `${answers.length} answers`}
          </p>
        </div>
        <button type="button" class="btn i" aria-label="Close the rounds" onClick={() => rounds.close()}>
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
          Forget all
        </button>
      </footer>
    </>
  );
}

interface Of {
  readonly subject: Subject;
}

const upper = (s: string): string => s.charAt(0).toUpperCase() + s.slice(1);

/** Of everybody speeds are told as those of vehicles. */
function unitFor(e: Editor, { id }: Subject): SpeedUnit {
  const a = id === null ? undefined : e.scene.value?.agents.get(id);
  return a ? e.unitOf(a) : e.speedUnit.value;
}

const percent = (v: number): string => `${Math.round(v * 100)}%`;

function RoundList({ subject }: Of) {
  const { editor, rounds } = useApp();
  const now = rounds.asked.value?.round ?? 1;
  const answers = subject.feedback?.answers ?? [];
  const done = new Set([...answers.map((x) => x.round), now]);
  const hand = editor.deck.hand.value;
  const matches = hand?.asked.round === now ? hand.round.cards.flatMap((x) => x.match ?? []) : [];
  return (
    <section class="sect roundlist">
      <h3>
        Rounds
        {matches.length ? <small>best match</small> : null}
      </h3>
      {[...done]
        .sort((x, y) => x - y)
        .map((n) => (
          <p key={n} aria-current={n === now ? 'step' : undefined}>
            <b>Round {n}</b>
            <span>{countWords(answers.filter((x) => x.round === n))}</span>
            <em>{n === now && matches.length ? percent(Math.max(...matches)) : ''}</em>
          </p>
        ))}
    </section>
  );
}

function countWords(of: readonly Answer[]): string {
  const kept = of.filter((x) => x.verdict === 'keep').length;
  return of.length ? `${kept} kept, ${of.length - kept} rejected` : 'nothing said yet';
}

function Wishes({ subject }: Of) {
  const { rounds } = useApp();
  const all = rounds.wished.value;
  return (
    <section class="sect wishes">
      <h3>
        Learnt wishes
        {all.some((w) => w.learned) ? <small>strength</small> : null}
      </h3>
      {all.map((w) => (
        <WishRow key={wishKey(w.wish)} wished={w} subject={subject} />
      ))}
      {all.length ? null : <p class="mut">None yet. They come with the next round, once three answers agree.</p>}
      <AddWish />
    </section>
  );
}

function WishRow({ wished, subject }: Of & { wished: Wished }) {
  const { editor, rounds } = useApp();
  const { words, learned } = wished;
  const scene = editor.scene.value!;
  const hand = editor.deck.hand.value;
  const answers = hand ? earlierAnswers(subject.feedback, hand.asked) : [];
  const rests = learned
    ? restsOn(learned, answers, { nameOf: nameIn(scene), unit: unitFor(editor, subject) })
    : 'You said so. It counts from the next round.';
  return (
    <div class="wishrow" data-wish={words}>
      <b>{words}</b>
      {learned ? <em>{percent(learned.strength)}</em> : null}
      <button type="button" class="btn i" aria-label={`Forget: ${words}`} onClick={() => rounds.forget(wished)}>
        <Icon name="x" size={13} />
      </button>
      {learned ? (
        <span class="bar" role="img" aria-label={`Strength ${percent(learned.strength)}`}>
          <i style={{ width: percent(learned.strength) }} />
        </span>
      ) : null}
      <p>{rests}</p>
    </div>
  );
}

function AddWish() {
  const { editor, rounds } = useApp();
  const hand = editor.deck.hand.value;
  const scene = editor.scene.value;
  if (!hand || !scene) return null;
  const known = new Set(rounds.wished.value.map((w) => wishKey(w.wish)));
  const features = hand.round.cards.map((card) => card.features);
  const all = wishes(hand.id, features, nameIn(scene)).filter((w) => !known.has(w.key));
  return (
    <select
      class="field pick"
      aria-label="Add a wish"
      value=""
      onChange={(e) => {
        const wish = all.find((w) => w.key === e.currentTarget.value)?.wish;
        e.currentTarget.selectedIndex = 0;
        e.currentTarget.blur();
        if (wish) rounds.wish(wish);
      }}
    >
      <option value="">Add a wish</option>
      {all.map((w) => (
        <option key={w.key} value={w.key}>
          {w.words}
        </option>
      ))}
    </select>
  );
}

/** More contradictions than this are counted. */
const MOST_NAMED = 3;

function Apart({ subject }: Of) {
  const { editor, rounds } = useApp();
  const hand = editor.deck.hand.value;
  if (!hand) return null;
  const answers = earlierAnswers(subject.feedback, hand.asked);
  const torn = rounds.wished.value.flatMap((w) => {
    const against = (w.learned?.against ?? []).flatMap((i) => answers[i] ?? []);
    return against.length ? [{ w, against }] : [];
  });
  if (!torn.length) return null;
  return (
    <section class="sect apart">
      <h3>Where they pull apart</h3>
      {torn.map(({ w, against }) => (
        <p key={w.words}>
          <b>{w.words}:</b> {against.slice(0, MOST_NAMED).map(againstWords).join(' ')}
          {against.length > MOST_NAMED ? ` And ${against.length - MOST_NAMED} more.` : ''}
        </p>
      ))}
    </section>
  );
}
