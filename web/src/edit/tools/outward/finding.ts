// What can go out is found by words: its label, its ending, what it is good for and the names that people have for it.

export interface Findable {
  readonly label: string;
  readonly ending: string;
  readonly says: string;
  /** The names under which others know it. */
  readonly name?: string;
}

const wordsOf = (sought: string): readonly string[] => sought.toLowerCase().trim().split(/\s+/);

/** Those that all words of a search are said of, in their order. */
export function found<T extends Findable>(all: readonly T[], sought: string): readonly T[] {
  const words = wordsOf(sought);
  return all.filter(({ label, ending, says, name = '' }) => {
    const said = `${label} ${ending} ${says} ${name}`.toLowerCase();
    return words.every((w) => said.includes(w));
  });
}

/** Which of them is meant most likely: a word that is the ending says more than one in a sentence about it. */
export function meant<T extends Findable>(all: readonly T[], sought: string): T | undefined {
  const words = wordsOf(sought);
  const off = (k: T): number => words.reduce((sum, w) => sum + offBy(k, w), 0);
  return [...all].sort((a, b) => off(a) - off(b)).at(0);
}

function offBy({ label, ending, name = '' }: Findable, word: string): number {
  if (ending === `.${word.replace(/^\./, '')}`) return 0;
  const called = label.toLowerCase();
  if (called === word) return 1;
  if (called.includes(word)) return 2;
  return name.toLowerCase().includes(word) ? 3 : 4;
}
