// Searches export formats by words: label, file ending, purpose and common names.

export interface Findable {
  readonly label: string;
  readonly ending: string;
  readonly says: string;
  /** Common names of the format. */
  readonly name?: string;
}

const wordsOf = (sought: string): readonly string[] => sought.toLowerCase().trim().split(/\s+/);

/** Formats that match all words of a search, in their order. */
export function found<T extends Findable>(all: readonly T[], sought: string): readonly T[] {
  const words = wordsOf(sought);
  return all.filter(({ label, ending, says, name = '' }) => {
    const said = `${label} ${ending} ${says} ${name}`.toLowerCase();
    return words.every((w) => said.includes(w));
  });
}

/** The likeliest match: a word equal to the ending outweighs one within a sentence. */
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
