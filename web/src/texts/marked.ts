// A pseudo language: every text has brackets and is longer by a third, so that a test finds texts outside the tables
// and texts without room to grow. It is never offered.
import type { Word, Words } from './words';

const LONGER = 1 / 3;

const mark = (text: string): string =>
  text.trim() === '' ? text : `⟦${text}${'·'.repeat(Math.ceil(text.length * LONGER))}⟧`;

function marking(word: Word | Words): Word | Words {
  if (typeof word === 'string') return mark(word);
  if (typeof word === 'function') return (...values: never[]) => mark(word(...values));
  return Object.fromEntries(Object.entries(word).map(([key, w]) => [key, marking(w)]));
}

export const marked = (_area: string, english: Words): Words => marking(english) as Words;
