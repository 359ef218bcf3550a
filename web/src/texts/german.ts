// German, one file for each table. It is a separate script and imports only types: the tables wait for it.
export { refused } from './german/refused';
export { taps } from './german/tapping';
import type { Words } from './words';

const files = import.meta.glob<{ readonly german: Words }>('./german/*/*.ts', { eager: true });

/** German words by area. */
export const german: Readonly<Record<string, Words>> = Object.fromEntries(
  Object.entries(files).map(([path, { german }]) => [/([\w-]+)\.ts$/.exec(path)![1], german]),
);
