// Rounds: futures of one road user, or ways the whole scene could go, are kept or rejected, and drawn anew by that.
import { LETTERS } from '../model/futures';
import { canChange } from '../model/scene';
import { saveFeedback } from '../edit/rounds/save';
import { hasFree, inGroup, type Action } from './action';
import type { Context } from './context';

const isOpen = (c: Context): boolean => c.rounds.isOpen.value;
const hasCards = (c: Context): true | string =>
  !isOpen(c) ? 'Open rounds first.' : c.editor.deck.hand.value ? true : 'No cards yet.';

/** At least two can do something: else the scene is that one road user. */
const hasSeveral = (c: Context): true | string => {
  const n = [...(c.editor.resting.value?.agents.values() ?? [])].filter(canChange).length;
  return n > 1 ? true : 'There are no two road users here that could do something else.';
};

/** One is selected, or there are several to do it all. */
const hasSubject = (c: Context): true | string => {
  const one = hasFree(c);
  return one === true || c.editor.selected.value.length ? one : hasSeveral(c);
};

function open(c: Context, one: boolean): void {
  c.variants.endCompare();
  c.ui.showEvents(false);
  if (one) c.rounds.open();
  else c.rounds.openScene();
}

const onCard = (run: (c: Context, index: number) => void): Pick<Action, 'onOffer' | 'when' | 'run'> => ({
  onOffer: isOpen,
  when: hasCards,
  run: (c) => run(c, c.editor.deck.current.value),
});

const cards = [...LETTERS].map((letter, i) => ({
  id: `round-card-${letter.toLowerCase()}`,
  label: `Card ${letter}`,
  keys: [`${i + 1}`],
  help: 'Keys are about it, and playback shows it',
  ...onCard((c) => c.editor.deck.point(i)),
}));

export const rounds = inGroup('Rounds', [
  {
    id: 'rounds',
    label: 'Rounds',
    keys: ['Shift+K'],
    icon: 'star',
    help: 'Keep and reject futures of one road user, or of the whole scene; the next ones follow what you like',
    when: hasSubject,
    checked: isOpen,
    run: (c) => {
      if (isOpen(c)) c.rounds.close();
      else open(c, hasFree(c) === true);
    },
  },
  {
    id: 'rounds-one',
    label: 'Rounds of this road user',
    help: 'Its own futures; nobody answers them',
    when: hasFree,
    checked: (c) => typeof c.editor.deck.of.value?.id === 'string',
    run: (c) => open(c, true),
  },
  {
    id: 'rounds-scene',
    label: 'Rounds of the whole scene',
    keys: ['Alt+K'],
    icon: 'layers',
    help: 'Each card is what everybody does together',
    when: hasSeveral,
    checked: (c) => c.editor.deck.of.value?.id === null,
    run: (c) => open(c, false),
  },
  {
    id: 'round-keep',
    label: 'Keep card',
    keys: ['K'],
    icon: 'check',
    help: 'The next round goes on from it; again: open',
    ...onCard((c, i) => c.rounds.say(i, 'keep')),
  },
  {
    id: 'round-reject',
    label: 'Reject card',
    keys: ['J'],
    icon: 'x',
    help: 'Nothing like it comes again; again: open',
    ...onCard((c, i) => c.rounds.say(i, 'reject')),
  },
  ...cards,
  {
    id: 'round-back',
    label: 'Card before',
    keys: ['Left'],
    help: 'Keys are about it, and playback shows it',
    ...onCard((c, i) => c.editor.deck.point(i - 1)),
  },
  {
    id: 'round-on',
    label: 'Card after',
    keys: ['Right'],
    help: 'Keys are about it, and playback shows it',
    ...onCard((c, i) => c.editor.deck.point(i + 1)),
  },
  {
    id: 'round-next',
    label: 'Next round',
    keys: ['Enter'],
    icon: 'next',
    help: 'More, by what was said',
    onOffer: isOpen,
    when: (c) => {
      const can = hasCards(c);
      return can !== true || c.rounds.mayGoOn.value ? can : 'Keep or reject one first, or add a wish.';
    },
    run: (c) => c.rounds.next(),
  },
  {
    id: 'round-take',
    label: 'Take this card',
    icon: 'flag',
    help: 'It is what happens from now on; others answer a card of one road user',
    when: hasCards,
    run: (c) => c.rounds.take(c.editor.deck.current.value),
  },
  {
    id: 'round-stop',
    label: 'Stop here',
    help: 'Closes the rounds; what was said stays',
    when: (c) => (isOpen(c) ? true : 'Open rounds first.'),
    run: (c) => c.rounds.close(),
  },
  {
    id: 'round-variants',
    label: 'Keep as variants',
    icon: 'variants',
    help: 'Closes the rounds; each kept card becomes a variant that the others answer',
    when: (c) => {
      const can = hasCards(c);
      return can !== true || c.rounds.said.value.some((s) => s?.verdict === 'keep') ? can : 'Keep a card first.';
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
    label: 'Save as table',
    icon: 'table',
    help: 'What was said of each card and what it is like, as CSV',
    when: (c) => {
      const of = c.rounds.subject.value ?? c.editor.agent.value;
      return of?.feedback?.answers.length ? true : 'Nothing was kept or rejected yet.';
    },
    run: (c) => saveFeedback(c.editor),
  },
]);
