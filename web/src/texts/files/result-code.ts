import { table } from '../table';

export const TEXTS = table('result-code', {
  label: (code: string) => `${code}, result code`,
  means: 'Result code: equal codes mean the same scene and the same motions. Click to copy',
  copied: (code: string) => `Code ${code} copied.`,
  code: 'Code',
  codeIs: (code: string) => `Code ${code}.`,
});
