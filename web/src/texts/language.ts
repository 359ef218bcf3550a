// The language of the page: the one that was chosen in the menu, else the browser's where enough of it is translated.
// It is known before any word is said: the tables wait for it, and the page is loaded anew when another one is chosen.
import type { Words } from './table';

/** What people choose from. English is the one that is complete; its words stand in the tables themselves. */
export const LANGUAGES = { en: 'English', de: 'Deutsch' } as const;
export type LanguageName = keyof typeof LANGUAGES;

/**
 * Share of the texts that are translated, in percent. A language that the browser asks for is taken by itself from
 * COMPLETE on; below that it is there for those who choose it. A test holds these numbers to the tables.
 */
export const TRANSLATED: Readonly<Record<LanguageName, number>> = { en: 100, de: 29 };
export const COMPLETE = 95;

const KEY = 'dragtraffic:language';

/** Marks every text, for tests: what is not marked stands in no table. */
const MARKED = 'qps';

function kept(): string | null {
  try {
    const text = localStorage.getItem(KEY);
    return text === null ? null : (JSON.parse(text) as string);
  } catch {
    // No storage, as in a worker, or none that may be read.
    return null;
  }
}

const isOffered = (name: string): name is LanguageName => name in LANGUAGES;

/** The language of one who has `chosen` it, or nothing yet, in a browser that prefers these, the first one most. */
export function languageFor(chosen: string | null, preferred: readonly string[]): LanguageName {
  if (chosen !== null && isOffered(chosen)) return chosen;
  for (const tag of preferred) {
    const [name] = tag.toLowerCase().split('-');
    if (isOffered(name)) return TRANSLATED[name] >= COMPLETE ? name : 'en';
  }
  return 'en';
}

const chosen = kept();

export const LANGUAGE = languageFor(chosen, typeof navigator === 'undefined' ? [] : (navigator.languages ?? []));

/** The forms that a text has by a number; a language that needs more of them has them in its own table. */
export type Forms = Readonly<Partial<Record<Intl.LDMLPluralRule, string>> & { other: string }>;

const rules = new Intl.PluralRules(LANGUAGE);

/** The form for so many, as this language counts. */
export const plural = (n: number, forms: Forms): string => forms[rules.select(n)] ?? forms.other;

/** A title within a sentence: small letters where the language writes it so; German nouns keep their capitals. */
export const inSentence = (title: string): string =>
  LANGUAGE === 'de' ? title : title.charAt(0).toLowerCase() + title.slice(1);

type Change = (area: string, english: Words) => Words;

/** What becomes of the words of an area; null where they stay as they are. */
async function changeOf(): Promise<Change | null> {
  if (chosen === MARKED) return (await import('./marked')).marked;
  if (LANGUAGE === 'en') return null;
  const { german } = await import('./german');
  const words: Readonly<Record<string, Words>> = german(plural);
  return (area, english) => over(english, words[area]);
}

/** The words of `own` in place of those of `english`. */
function over(english: Words, own: Words | undefined): Words {
  if (!own) return english;
  return Object.fromEntries(
    Object.entries(english).map(([key, word]) => {
      const mine = own[key];
      return [key, typeof word === 'object' ? over(word, mine as Words | undefined) : (mine ?? word)];
    }),
  );
}

export const change = await changeOf();

/** The one after this one, in the order of the list. */
const names = Object.keys(LANGUAGES) as LanguageName[];
export const nextLanguage = names[(names.indexOf(LANGUAGE) + 1) % names.length];

/** Says everything in another language: the page is loaded anew, and shows what it showed. */
export function speak(name: LanguageName): void {
  try {
    localStorage.setItem(KEY, JSON.stringify(name));
  } catch {
    return;
  }
  location.reload();
}

/** Places that say themselves where they are: `off the lanes`, `in the crossing`. */
export const SAYS_WHERE = /^(on|off|inside|beside|in) /;
