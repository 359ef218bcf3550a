// Tables of texts (src/texts) have keys that say what they are for. In the build a letter or two does: a script has
// hundreds of them, each twice. Only tables by the name of TEXTS are so treated.
import { readFileSync } from 'node:fs';
import type { Plugin } from 'vite';

/** A key at the start of its line, in a table as the formatter leaves it. */
const KEY = /^ {2}(\w+):/gm;
const TABLE = /\/src\/texts\/([\w-]+)\.ts$/;
const IMPORT = /import (?:type )?\{ TEXTS(?: as (\w+))? \} from '[./]*\/(?:texts\/)?([\w-]+)';/g;

const LETTERS = 'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ';
const short = (i: number): string =>
  (i < LETTERS.length ? '' : short(Math.floor(i / LETTERS.length) - 1)) + LETTERS[i % LETTERS.length];

export function shortKeys(): Plugin {
  const known = new Map<string, ReadonlyMap<string, string>>();
  /** Key of an area: what stands for it. */
  const keysOf = (area: string): ReadonlyMap<string, string> => {
    let keys = known.get(area);
    if (!keys) {
      const table = readFileSync(new URL(`../src/texts/${area}.ts`, import.meta.url), 'utf8');
      keys = new Map([...table.matchAll(KEY)].map(([, key], i) => [key, short(i)]));
      known.set(area, keys);
    }
    return keys;
  };
  /** A language has the tables of many areas: each says whose it is by its type. */
  const inLanguage = (code: string): string => {
    const areas = new Map([...code.matchAll(IMPORT)].map(([, as, area]) => [as, area]));
    let keys: ReadonlyMap<string, string> | null = null;
    let indent = '';
    return code
      .split('\n')
      .map((line) => {
        const begins = /^( *)const \w+: Part<typeof (\w+)> = \{$/.exec(line);
        if (begins) {
          indent = `${begins[1]}  `;
          const area = areas.get(begins[2]);
          keys = area ? keysOf(area) : null;
          return line;
        }
        const key = keys && line.startsWith(indent) ? /^\w+(?=:)/.exec(line.slice(indent.length))?.[0] : undefined;
        return key ? `${indent}${keys!.get(key)}${line.slice(indent.length + key.length)}` : line;
      })
      .join('\n');
  };
  return {
    name: 'short-keys',
    apply: 'build',
    enforce: 'pre',
    transform(code, id) {
      if (/Part<typeof/.test(code) && TABLE.test(id)) return inLanguage(code);
      const table = TABLE.exec(id);
      if (table && /\bTEXTS\b/.test(code)) {
        const keys = keysOf(table[1]);
        return code.replace(KEY, (all, key: string) => `  ${keys.get(key) ?? this.error(`${all} is in no table`)}:`);
      }
      let out = code;
      for (const [, as, area] of code.matchAll(IMPORT)) {
        const keys = keysOf(area);
        if (new RegExp(`\\b${as ?? 'TEXTS'}\\[`).test(code))
          this.error(`${id}: give a table that is indexed a name of its own`);
        out = out.replace(new RegExp(`\\b${as ?? 'TEXTS'}\\.(\\w+)`, 'g'), (all, key: string) => {
          const letters = keys.get(key);
          return letters ? `${as ?? 'TEXTS'}.${letters}` : this.error(`${all} is in no table`);
        });
      }
      return out === code ? null : out;
    },
  };
}
