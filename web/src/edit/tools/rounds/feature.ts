// Rounds of cards that the user judges.
import type { Feature } from '../feature';
import { Deck } from './deck';
import { Rounds } from './rounds';

export const ROUNDS = {
  make({ editor, generator, questions }) {
    const deck = new Deck(editor.scene);
    editor.reading.layCards(deck);
    editor.join(deck);
    return { named: { deck, rounds: new Rounds(editor, deck, questions(), generator()) } };
  },
} satisfies Feature;
