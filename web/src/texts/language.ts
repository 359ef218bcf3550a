// The language of the page: the one chosen in the menu, else the browser's. It is known before any text is read: the
// tables wait for it, and a change reloads the page.
import type { Words } from './words';
import type { Taps } from './tapping';

/** Languages in the menu. English texts are in the tables themselves. */
export const LANGUAGES = { en: 'English', de: 'Deutsch' } as const;
export type LanguageName = keyof typeof LANGUAGES;

const KEY = 'dragtraffic:language';

/** Marks every text, for tests: an unmarked text is in no table. */
const MARKED = 'qps';

function kept(): string | null {
  try {
    const text = localStorage.getItem(KEY);
    return text === null ? null : (JSON.parse(text) as string);
  } catch {
    // Storage is missing, as in a worker, or forbidden.
    return null;
  }
}

const isOffered = (name: string): name is LanguageName => name in LANGUAGES;

/** The language after a choice, or without one, for a browser with these preferences, the first one strongest. */
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

/** Format of dates; in English the browser's, since it depends on the country whether day or month comes first. */
export const LOCALE = LANGUAGE === 'en' ? undefined : LANGUAGE;

/** Forms of a text by number; a language with more of them has them in its own table. */
export type Forms = Readonly<Partial<Record<Intl.LDMLPluralRule, string>> & { other: string }>;

const rules = new Intl.PluralRules(LANGUAGE);

/** The form for a number, by the rules of this language. */
export const plural = (n: number, forms: Forms): string => forms[rules.select(n)] ?? forms.other;

/** A title within a sentence: in lower case where the language does so; German nouns keep their capitals. */
export const inSentence = (title: string): string =>
  LANGUAGE === 'de' ? title : title.charAt(0).toLowerCase() + title.slice(1);

/** Words at the start of a sentence. */
export const capitalised = (words: string): string => words.charAt(0).toUpperCase() + words.slice(1);

/** Texts of another language; null where they stay unchanged. */
interface Translation {
  area(area: string, english: Words): Words;
  /** Text of a refusal of the server, by code; `undefined` where there is none. */
  refused(code: string): string | undefined;
  readonly taps: Taps;
}

async function changeOf(): Promise<Translation | null> {
  if (chosen === MARKED) {
    const { marked } = await import('./marked');
    return { area: marked, refused: () => undefined, taps: [] };
  }
  if (LANGUAGE === 'en') return null;
  const { german, refused, taps } = await import('./german');
  return { area: (area) => german[area], refused: (code) => refused[code], taps };
}

export const change = await changeOf();

/** The next language in the order of the list. */
const names = Object.keys(LANGUAGES) as LanguageName[];
export const nextLanguage = names[(names.indexOf(LANGUAGE) + 1) % names.length];

/** Switches the language: reloads the page with the same view. */
export function speak(name: LanguageName): void {
  try {
    localStorage.setItem(KEY, JSON.stringify(name));
  } catch {
    return;
  }
  location.reload();
}
