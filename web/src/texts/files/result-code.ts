import { table } from '../table';

export const TEXTS = table('result-code', {
  label: (code: string) => `${code}, code of this result`,
  means: 'Code of this result: the same scene, seed and version show the same one. A click copies it',
  copied: (code: string) => `Code ${code} copied.`,
  code: 'Code',
  codeIs: (code: string) => `Code ${code}.`,
});
