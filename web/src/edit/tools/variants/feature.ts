// Variants of the open scene.
import { Maker } from '../../asking/take-maker';
import type { Feature } from '../feature';
import { Variants } from './variants';

export const VARIANTS = {
  make({ editor, file, generator, questions }) {
    const own = generator();
    const variants = new Variants(editor, new Maker(editor, questions(), own, file), () => own.cancel());
    file.variantTakes = () => [...new Set([...variants.within('kept'), ...variants.within('starred')])];
    editor.join({ asking: variants.busy });
    return { named: { variants } };
  },
} satisfies Feature;
