// Ways out that are tried before anybody takes one.
import { RemedyPreview } from '../../asking/remedy-preview';
import { WhatIf } from '../../asking/what-if';
import type { Feature } from '../feature';

export const REMEDIES = {
  make({ editor, file, generator, questions }) {
    const pointed = new WhatIf(editor, questions(), generator(), file);
    // Of ways out that nobody points at.
    const whatIf = new WhatIf(editor, questions(), generator(), file);
    const remedyPreview = new RemedyPreview(editor, pointed);
    editor.join(remedyPreview);
    editor.join(whatIf);
    return { named: { remedyPreview, whatIf } };
  },
} satisfies Feature;
