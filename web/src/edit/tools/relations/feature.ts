// Goals relative to another road user.
import type { Feature } from '../feature';
import { LateRelationOverlay } from './late-relation-overlay';

export const RELATIONS = {
  make: ({ editor }) => ({ named: {}, overlay: new LateRelationOverlay(editor) }),
} satisfies Feature;
