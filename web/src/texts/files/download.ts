import { plural, table } from '../table';

export const TEXTS = table('download', {
  notExported: (whyNot: string) => `Not exported: ${whyNot}`,
  theServerIsNotThere: 'the server is not answering.',
  files: (count: number) => `${count} files`,
  savedWithout: (n: number, what: string) =>
    plural(n, { one: `${what} saved, ${n} detail not exported.`, other: `${what} saved, ${n} details not exported.` }),
  saved: (what: string) => `${what} saved.`,
});
