// A button that makes a change shows what comes of it while the pointer or the focus is on it.
import { useEffect, useRef } from 'preact/hooks';
import type { Command } from '../../model/document/commands';
import { useApp } from './app-context';

export function useTrying(command: Command) {
  const { remedyPreview } = useApp();
  const on = useRef(false);
  const begin = () => {
    on.current = true;
    remedyPreview.begin(command);
  };
  const stop = () => {
    on.current = false;
    remedyPreview.stop();
  };
  // A button that goes from under the pointer hears nothing of its leaving.
  useEffect(
    () => () => {
      if (on.current) remedyPreview.stop();
    },
    [remedyPreview],
  );
  return { onPointerEnter: begin, onPointerLeave: stop, onFocus: begin, onBlur: stop };
}
