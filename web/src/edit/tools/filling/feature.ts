// An area that is filled with road users.
import { FILL, fillingTool } from './fill-gesture';
import { Filler } from './filler';
import { Filling } from './filling';
import { LateFillOverlay } from './late-fill-overlay';
import type { Feature } from '../feature';

export const FILLING = {
  rail: [FILL],
  make({ editor, file, client }) {
    const filling = new Filling(editor);
    editor.join(filling);
    return {
      named: { filling, filler: new Filler(editor, filling, file, client) },
      tools: [fillingTool(filling)],
      overlay: new LateFillOverlay(editor, filling),
    };
  },
} satisfies Feature;
