// The search for a case.
import type { Feature } from '../feature';
import { Searching } from './searching';

export const CASES = {
  make: (of) => ({ named: { searching: new Searching(of) } }),
} satisfies Feature;
