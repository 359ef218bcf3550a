import type { TEXTS } from '../../files/result-code';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  label: (code) => `${code}, Code dieses Ergebnisses`,
  means:
    'Code dieses Ergebnisses: gleiche Szene, gleicher Startwert und gleiche Version zeigen denselben. Ein Klick kopiert ihn',
  copied: (code) => `Code ${code} kopiert.`,
  code: 'Code',
  codeIs: (code) => `Code ${code}.`,
};
