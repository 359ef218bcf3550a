// A road user driven by the keyboard.
import { PAN } from '../../gestures/panning';
import type { Feature } from '../feature';
import { Driving } from './driving';
import { DrivingOverlay } from './driving-overlay';

export const DRIVING = {
  make({ client, editor, file }) {
    const driving = new Driving(editor, file, client);
    editor.join(driving);
    editor.reading.showLive(driving);
    // A press selects nothing meanwhile.
    const takesOver = () => (driving.isOn.peek() ? PAN : null);
    return { named: { driving }, overlay: new DrivingOverlay(editor, driving), takesOver };
  },
} satisfies Feature;
