// A map that is made by hand.
import { computed } from '@preact/signals-core';
import { PAN } from '../../gestures/panning';
import type { Feature } from '../feature';
import { LayoutMaker } from './layout-maker';
import { LateTools } from './late-tools';
import { LayoutOverlay } from './layout-overlay';
import { Layouts } from './layouts';

export const LAYOUTS = {
  make({ editor, file, care, client }) {
    const layouts = new Layouts();
    const late = new LateTools();
    const maker = new LayoutMaker(editor, layouts, late, file, care, client);
    editor.join(layouts);
    editor.join(maker);
    editor.view.showMapsOf({ isOpen: layouts.isOpen, scene: computed(() => layouts.made.value?.scene ?? null) });
    return {
      named: { layouts, maker },
      overlay: new LayoutOverlay(layouts, late),
      takesOver: () => (layouts.isOpen.peek() ? (late.tools.peek()?.makingTool(layouts) ?? PAN) : null),
    };
  },
} satisfies Feature;
