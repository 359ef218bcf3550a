// The language of the page: the one that was chosen in the menu, else the browser's.
// It is known before any word is said: the tables wait for it, and the page is loaded anew when another one is chosen.
import type { Words } from './words';
import type { Taps } from './tapping';

/** What people choose from. The words of English stand in the tables themselves. */
export const LANGUAGES = { en: 'English', de: 'Deutsch' } as const;
export type LanguageName = keyof typeof LANGUAGES;

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
    if (isOffered(name)) return name;
  }
  return 'en';
}

const chosen = kept();

export const LANGUAGE = languageFor(chosen, typeof navigator === 'undefined' ? [] : (navigator.languages ?? []));

/** How dates are written; in English as the browser has it, which knows whether the day or the month comes first. */
export const LOCALE = LANGUAGE === 'en' ? undefined : LANGUAGE;

/** The forms that a text has by a number; a language that needs more of them has them in its own table. */
export type Forms = Readonly<Partial<Record<Intl.LDMLPluralRule, string>> & { other: string }>;

const rules = new Intl.PluralRules(LANGUAGE);

/** The form for so many, as this language counts. */
export const plural = (n: number, forms: Forms): string => forms[rules.select(n)] ?? forms.other;

/** A title within a sentence: small letters where the language writes it so; German nouns keep their capitals. */
export const inSentence = (title: string): string =>
  LANGUAGE === 'de' ? title : title.charAt(0).toLowerCase() + title.slice(1);

/** The words of another language; null where they stay as they are. */
interface Change {
  area(area: string, english: Words): Words;
  /** What the server refuses, by its code; `undefined` where that is not known. */
  refused(code: string): string | undefined;
  readonly taps: Taps;
}

async function changeOf(): Promise<Change | null> {
  if (chosen === MARKED) {
    const { marked } = await import('./marked');
    return { area: marked, refused: () => undefined, taps: [] };
  }
  if (LANGUAGE === 'en') return null;
  const { german, refused, taps } = await import('./german');
  return { area: (area) => german[area], refused: (code) => refused[code], taps };
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

/** Places that say themselves where they are: `off the lanes`, `in the junction`. */
export const SAYS_WHERE = /^(on|off|inside|beside|in) /;
