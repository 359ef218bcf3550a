// Remedies are tried before the user takes one.
import { RemedyPreview } from '../../asking/remedy-preview';
import { WhatIf } from '../../asking/what-if';
import type { Feature } from '../feature';

export const REMEDIES = {
  make({ editor, file, generator, questions }) {
    const pointed = new WhatIf(editor, questions(), generator(), file);
    // Tries remedies that are not under the pointer.
    const whatIf = new WhatIf(editor, questions(), generator(), file);
    const remedyPreview = new RemedyPreview(editor, pointed);
    editor.join(remedyPreview);
    editor.join(whatIf);
    return { named: { remedyPreview, whatIf } };
  },
} satisfies Feature;
