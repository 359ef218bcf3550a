// Tables of texts (src/texts) have keys that say what they are for. In the build a letter or two does: a script has
// hundreds of them, each twice. Only tables by the name of TEXTS are so treated.
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import type { Plugin } from 'vite';

/** A key at the start of its line, in a table as the formatter leaves it. */
const KEY = /^ {2}(\w+):/gm;
/** A table by its path: the room and the name of it, in English or in German. */
const TABLE = /\/src\/texts\/(?:german\/)?([\w-]+\/[\w-]+)(?:\.ts)?$/;
const IMPORT = /import (?:type )?\{ TEXTS(?: as (\w+))? \} from '([^']+)';/g;

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
  const shortened = (code: string, area: string, fail: (why: string) => never): string => {
    const keys = keysOf(area);
    return code.replace(KEY, (all, key: string) => `  ${keys.get(key) ?? fail(`${all} is in no table`)}:`);
  };
  return {
    name: 'short-keys',
    apply: 'build',
    enforce: 'pre',
    transform(code, id) {
      const table = TABLE.exec(id);
      if (table && /^ *\.\.\.|\{ \.\.\./m.test(code)) this.error(`${id}: write a table out, its keys become others`);
      if (table && /\bTEXTS\b/.test(code)) return shortened(code, table[1], (why) => this.error(why));
      let out = code;
      for (const [, as, from] of code.matchAll(IMPORT)) {
        const keys = keysOf(TABLE.exec(resolve(id, '..', from))![1]);
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
