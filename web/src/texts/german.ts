// German, a file for each table. It comes as a script of its own and imports nothing from elsewhere but types: the tables
// wait for it.
export { refused } from './german/refused';
export { taps } from './german/tapping';
import type { Words } from './words';

const files = import.meta.glob<{ readonly german: Words }>('./german/*/*.ts', { eager: true });

/** Area: its words in German. */
export const german: Readonly<Record<string, Words>> = Object.fromEntries(
  Object.entries(files).map(([path, { german }]) => [/([\w-]+)\.ts$/.exec(path)![1], german]),
);
