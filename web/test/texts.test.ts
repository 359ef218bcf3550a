// Tables of texts: what share of them a language has, how numbers are told, and who gets which language.
import { describe, expect, it } from 'vitest';
import { german } from '../src/texts/german';
import { COMPLETE, inSentence, languageFor, LANGUAGE, plural, TRANSLATED } from '../src/texts/language';
import { marked } from '../src/texts/marked';
import { table, type Words } from '../src/texts/table';

const modules = import.meta.glob<Record<string, unknown>>('../src/texts/*.ts', { eager: true });
const NO_TABLES = ['language', 'table', 'german', 'marked'];
const areas = new Map<string, Words>();
for (const [path, module] of Object.entries(modules)) {
  const name = /([\w-]+)\.ts$/.exec(path)![1];
  if (!NO_TABLES.includes(name)) areas.set(name, Object.values(module)[0] as Words);
}

/** Paths of all texts of an area. */
const paths = (words: Words): string[] =>
  Object.entries(words).flatMap(([key, w]) => (typeof w === 'object' ? paths(w).map((p) => `${key}.${p}`) : [key]));
const all = [...areas].flatMap(([area, words]) => paths(words).map((p) => `${area}.${p}`));
const own = Object.entries(german(plural) as Record<string, Words>).flatMap(([area, words]) =>
  paths(words).map((p) => `${area}.${p}`),
);

describe('texts', () => {
  it('has every text of a language under the same key in English, and says what share it has', () => {
    const known = new Set(all);
    expect(own.filter((key) => !known.has(key))).toEqual([]);
    const share = (100 * own.length) / all.length;
    console.log(
      `Texts: ${all.length} in ${areas.size} tables; German has ${own.length} of them, ${share.toFixed(0)} %.`,
    );
    expect(Math.abs(TRANSLATED.de - share)).toBeLessThan(2);
  });

  it('takes the language of the browser where enough of it is there, and any that is chosen', () => {
    expect(LANGUAGE).toBe('en');
    const offered = TRANSLATED.de >= COMPLETE ? 'de' : 'en';
    expect(languageFor(null, ['de-AT', 'en'])).toBe(offered);
    expect(languageFor(null, ['fr', 'en-GB'])).toBe('en');
    expect(languageFor('de', ['en'])).toBe('de');
    expect(languageFor('xx', [])).toBe('en');
  });

  it('says numbers in the forms of the language', () => {
    const cars = (n: number) => plural(n, { one: `${n} car`, other: `${n} cars` });
    expect([0, 1, 2].map(cars)).toEqual(['0 cars', '1 car', '2 cars']);
    expect(inSentence('Near miss')).toBe('near miss');
  });

  it('marks every text of a table, also those with values in them', () => {
    const english = { plain: 'Undo', nested: { of: (n: number) => `${n} of 6` } };
    expect(table('test', english)).toBe(english);
    const said = marked('test', english) as unknown as typeof english;
    expect(said.plain).toBe('⟦Undo··⟧');
    expect(said.nested.of(2)).toBe('⟦2 of 6··⟧');
  });
});
