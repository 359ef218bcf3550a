import type { TEXTS } from '../../files/download';
import { plural } from '../plural';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  notExported: (whyNot) => `Nicht exportiert: ${whyNot}`,
  theServerIsNotThere: 'der Server antwortet nicht.',
  files: (count) => `${count} Dateien`,
  savedWithout: (n, what) =>
    plural(n, {
      one: `${what} gesichert, ${n} Angabe nicht exportiert.`,
      other: `${what} gesichert, ${n} Angaben nicht exportiert.`,
    }),
  saved: (what) => `${what} gesichert.`,
};
