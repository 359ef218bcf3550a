// Parts of the map that a click picks: shown in the panel, signals with their phases on the timeline.
import type { Feature } from '../feature';
import { MapItemOverlay } from './map-item-overlay';
import { SignalEdges } from './signal-edges';

export const MAP_ITEMS = {
  make({ editor }) {
    const signalEdges = new SignalEdges(editor);
    editor.join(signalEdges);
    return { named: { signalEdges }, overlay: new MapItemOverlay(editor, signalEdges) };
  },
} satisfies Feature;
