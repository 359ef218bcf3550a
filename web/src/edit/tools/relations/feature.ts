// Goals relative to another road user.
import type { Feature } from '../feature';
import { GapOffer } from './gap-offer';
import { LateRelationOverlay } from './late-relation-overlay';

export const RELATIONS = {
  make({ editor }) {
    const gapOffer = new GapOffer(editor);
    editor.join(gapOffer);
    const overlay = new LateRelationOverlay(editor, gapOffer);
    return { named: { gapOffer }, overlay, handleAt: (x, y) => overlay.handleAt(x, y) };
  },
} satisfies Feature;
