import { table } from '../table';

export const TEXTS = table('result-code', {
  label: (code: string) => `${code}, result code`,
  means: 'Result code: the same scene, seed and version give the same code. Click to copy',
  copied: (code: string) => `Code ${code} copied.`,
  code: 'Code',
  codeIs: (code: string) => `Code ${code}.`,
});
