// Placing of road users, and copies of them.
import { PLACE } from '../../gestures/placing';
import { Copying } from '../../moves/copying';
import type { Feature } from '../feature';
import { NewcomersOverlay } from './newcomers-overlay';

export const PLACING = {
  rail: PLACE,
  make({ editor, placement }) {
    editor.join(placement);
    return {
      named: { placement, copying: new Copying(editor) },
      tools: PLACE,
      overlay: new NewcomersOverlay(editor, placement),
    };
  },
} satisfies Feature;
