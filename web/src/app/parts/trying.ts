// A button with a change previews the outcome while it has the pointer or the focus.
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
  // A button that is removed under the pointer gets no leave event.
  useEffect(
    () => () => {
      if (on.current) remedyPreview.stop();
    },
    [remedyPreview],
  );
  return { onPointerEnter: begin, onPointerLeave: stop, onFocus: begin, onBlur: stop };
}
