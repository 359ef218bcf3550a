// The search for a case.
import { Maker } from '../../asking/take-maker';
import type { Feature } from '../feature';
import { Searching } from './searching';

export const CASES = {
  make({ editor, file, generator, questions }) {
    const own = generator();
    const maker = new Maker(editor, questions(), own, file);
    return { named: { searching: new Searching(editor, maker, () => own.cancel()) } };
  },
} satisfies Feature;
