// Tables of texts: all have their German, with the same values; plural forms, and the choice of the language.
import { describe, expect, it } from 'vitest';
import { readFileSync } from 'node:fs';
import { german, refused, taps } from '../../src/texts/german';
import { inSentence, languageFor, LANGUAGE, plural } from '../../src/texts/language';
import { marked } from '../../src/texts/marked';
import { table } from '../../src/texts/table';
import type { Word, Words } from '../../src/texts/words';
import { ENGLISH, tapping } from '../../src/texts/tapping';

const modules = import.meta.glob<Record<string, unknown>>(['../../src/texts/*/*.ts', '!**/german/**'], { eager: true });
const areas = new Map<string, Words>();
for (const [path, module] of Object.entries(modules)) {
  const name = /([\w-]+)\.ts$/.exec(path)![1];
  areas.set(name, Object.values(module)[0] as Words);
}

/** All texts of an area, each with its path. */
const textsOf = (words: Words, path: string): [string, Word][] =>
  Object.entries(words).flatMap(([key, w]): [string, Word][] =>
    typeof w === 'object' ? textsOf(w, `${path}.${key}`) : [[`${path}.${key}`, w]],
  );
const english = new Map([...areas].flatMap(([area, words]) => textsOf(words, area)));
/** Words of refusals are their own English; `messages.test.ts` compares them with those that the server knows. */
const isWord = (key: string) => key.startsWith('refusal-messages.lists.');
const all = Object.entries(german).flatMap(([area, words]) => textsOf(words, area));
const own = new Map(all.filter(([key]) => !isWord(key)));

/** The given values that appear in a text. */
const said = (w: Word, value: (i: number) => unknown): string => {
  if (typeof w === 'string') return '';
  const values = Array.from({ length: w.length }, (_, i) => value(i));
  const text = (w as (...v: unknown[]) => string)(...values);
  return values.filter((v) => text.includes(String(v))).join();
};

describe('texts', () => {
  it('have their German, every one, and nothing else has', () => {
    console.log(`Texts: ${english.size} in ${areas.size} tables; German has ${own.size}.`);
    expect([...english.keys()].filter((key) => !own.has(key))).toEqual([]);
    expect([...own.keys()].filter((key) => !english.has(key))).toEqual([]);
  });

  it('contain the same values in German', () => {
    const differ: string[] = [];
    for (const [key, w] of english) {
      const mine = own.get(key)!;
      const taken = [w, mine].map((x) => (typeof x === 'function' ? x.length : null));
      const values = [w, mine].map((x) => said(x, (i) => `⟨${i}⟩`));
      if (taken[0] !== taken[1] || values[0] !== values[1]) differ.push(`${key}: ${values.join(' / ')}`);
    }
    expect(differ).toEqual([]);
  });

  it('speak of taps on a touch device', () => {
    const spoken = (all: Record<string, Words>, as: typeof taps) =>
      Object.entries(all).flatMap(([area, words]) => textsOf(tapping(words, as), area));
    const left = [...spoken(Object.fromEntries(areas), ENGLISH), ...spoken(german, taps)].filter(
      ([, w]) => typeof w === 'string' && /click|klick/i.test(w),
    );
    expect(left).toEqual([]);
    expect(tapping({ of: { a: 'Click a car' }, by: (n: string) => `click ${n}` }, ENGLISH).of).toEqual({
      a: 'Tap a car',
    });
    expect(tapping({ a: 'Doppelklick: ein Klick zum Anklicken' }, taps)).toEqual({
      a: 'Doppeltippen: ein Tippen zum Antippen',
    });
  });

  it('cover every refusal of the server in German', () => {
    const document = JSON.parse(readFileSync('../assets/openapi.json', 'utf8')) as {
      components: { schemas: { Problem: { properties: { code: { enum: string[] } } } } };
    };
    const codes = document.components.schemas.Problem.properties.code.enum;
    expect(codes.length).toBeGreaterThan(40);
    expect(Object.keys(refused).sort()).toEqual([...codes].sort());
  });

  it("takes the browser's language where available, and any chosen one", () => {
    expect(LANGUAGE).toBe('en');
    expect(languageFor(null, ['de-AT', 'en'])).toBe('de');
    expect(languageFor(null, ['fr', 'en-GB'])).toBe('en');
    expect(languageFor('de', ['en'])).toBe('de');
    expect(languageFor('xx', [])).toBe('en');
  });

  it('uses the plural forms of the language', () => {
    const cars = (n: number) => plural(n, { one: `${n} car`, other: `${n} cars` });
    expect([0, 1, 2].map(cars)).toEqual(['0 cars', '1 car', '2 cars']);
    expect(inSentence('Near miss')).toBe('near miss');
  });

  it('marks every text of a table, also those with values', () => {
    const plain = { plain: 'Undo', nested: { of: (n: number) => `${n} of 6` } };
    expect(table('test', plain)).toBe(plain);
    const out = marked('test', plain) as unknown as typeof plain;
    expect(out.plain).toBe('⟦Undo··⟧');
    expect(out.nested.of(2)).toBe('⟦2 of 6··⟧');
  });
});
