import type { TEXTS } from '../../files/result-code';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  label: (code) => `${code}, Ergebniscode`,
  means: 'Ergebniscode: Gleicher Code heißt gleiche Szene und gleiche Bewegungen. Klicken zum Kopieren',
  copied: (code) => `Code ${code} kopiert.`,
  code: 'Code',
  codeIs: (code) => `Code ${code}.`,
};
