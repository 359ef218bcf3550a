// Rounds: futures of one road user, or alternatives of the whole scene, are kept or rejected, and drawn again from
// that.
import { LETTERS } from '../model/document/futures';
import { canChange } from '../model/document/scene';
import { hasFree, inGroup, type Action } from './action';
import type { Context } from './context';
import { TEXTS as PAGE } from '../texts/desk/page';
import { TEXTS } from '../texts/desk/actions';

const isOpen = (c: Context): boolean => c.rounds.isOpen.value;
const hasCards = (c: Context): true | string =>
  !isOpen(c) ? TEXTS.openRoundsFirst : c.deck.hand.value ? true : TEXTS.noCardsYet;

/** At least two can move: otherwise the scene is that one road user. */
const hasSeveral = (c: Context): true | string => {
  const n = [...(c.editor.resting.value?.agents.values() ?? [])].filter(canChange).length;
  return n > 1 ? true : TEXTS.roundsNeedTwo;
};

/** One is selected, or there are several for the whole scene. */
const hasSubject = (c: Context): true | string => {
  const one = hasFree(c);
  return one === true || c.editor.selected.value.length ? one : hasSeveral(c);
};

function open(c: Context, one: boolean): void {
  c.variants.comparing.end();
  c.ui.showEvents(false);
  if (one) c.rounds.open();
  else c.rounds.openScene();
}

const onCard = (run: (c: Context, index: number) => void): Pick<Action, 'onOffer' | 'when' | 'run'> => ({
  onOffer: isOpen,
  when: hasCards,
  run: (c) => run(c, c.deck.current.value),
});

const cards = [...LETTERS].map((letter, i) => ({
  id: `round-card-${letter.toLowerCase()}`,
  label: TEXTS.card(letter),
  keys: [`${i + 1}`],
  help: 'keysActOnThisCard' as const,
  ...onCard((c) => c.deck.point(i)),
}));

export const rounds = inGroup('rounds', [
  {
    id: 'rounds',
    label: TEXTS.rounds,
    keys: ['Shift+K'],
    icon: 'star',
    help: 'keepAndReject',
    when: hasSubject,
    checked: isOpen,
    run: (c) => {
      if (isOpen(c)) c.rounds.close();
      else open(c, hasFree(c) === true);
    },
  },
  {
    id: 'rounds-one',
    label: TEXTS.roundsOfThis,
    help: 'withoutReactions',
    when: hasFree,
    checked: (c) => typeof c.deck.of.value?.id === 'string',
    run: (c) => open(c, true),
  },
  {
    id: 'rounds-scene',
    label: TEXTS.roundsOfTheWhole,
    keys: ['Alt+K'],
    icon: 'layers',
    help: 'eachCardIs',
    when: hasSeveral,
    checked: (c) => c.deck.of.value?.id === null,
    run: (c) => open(c, false),
  },
  {
    id: 'round-keep',
    label: TEXTS.keepCard,
    keys: ['K'],
    icon: 'check',
    help: 'theNextRound',
    ...onCard((c, i) => c.rounds.say(i, 'keep')),
  },
  {
    id: 'round-reject',
    label: TEXTS.rejectCard,
    keys: ['J'],
    icon: 'x',
    help: 'similarDoNotComeAgain',
    ...onCard((c, i) => c.rounds.say(i, 'reject')),
  },
  ...cards,
  {
    id: 'round-back',
    label: TEXTS.previousCard,
    keys: ['Left'],
    help: 'keysActOnThisCard',
    ...onCard((c, i) => c.deck.point(i - 1)),
  },
  {
    id: 'round-on',
    label: TEXTS.nextCard,
    keys: ['Right'],
    help: 'keysActOnThisCard',
    ...onCard((c, i) => c.deck.point(i + 1)),
  },
  {
    id: 'round-next',
    label: TEXTS.nextRound,
    keys: ['Enter'],
    icon: 'next',
    help: 'moreCards',
    onOffer: isOpen,
    when: (c) => {
      const can = hasCards(c);
      return can !== true || c.rounds.mayGoOn.value ? can : TEXTS.keepOrReject;
    },
    run: (c) => c.rounds.next(),
  },
  {
    id: 'round-take',
    label: TEXTS.takeThisCard,
    icon: 'flag',
    help: 'usesItInTheScene',
    when: hasCards,
    run: (c) => c.rounds.take(c.deck.current.value),
  },
  {
    id: 'round-stop',
    label: TEXTS.endRounds,
    help: 'closesTheRounds',
    when: (c) => (isOpen(c) ? true : TEXTS.openRoundsFirst),
    run: (c) => c.rounds.close(),
  },
  {
    id: 'round-variants',
    label: TEXTS.keepAsVariants,
    icon: 'variants',
    help: 'closesTheRoundsEach',
    when: (c) => {
      const can = hasCards(c);
      return can !== true || c.rounds.said.value.some((s) => s?.verdict === 'keep') ? can : TEXTS.keepACardFirst;
    },
    run: (c) => {
      const kept = c.rounds.kept();
      c.rounds.close();
      if (kept && 'futures' in kept) void c.variants.keepDealt(kept);
      else if (kept) c.variants.keepTakes(kept);
    },
  },
  {
    id: 'round-table',
    label: TEXTS.saveAsTable,
    icon: 'table',
    help: 'answersAsCsv',
    when: (c) => {
      const of = c.rounds.subject.value ?? c.editor.agent.value;
      return of?.feedback?.answers.length ? true : TEXTS.nothingWasKept;
    },
    run: (c) =>
      void import('../edit/tools/rounds/save').then(
        (m) => m.saveFeedback(c.editor, c.deck),
        () => c.editor.notices.show({ text: PAGE.thisPartOfThe }),
      ),
  },
]);
