// A button that makes a change shows what comes of it while the pointer or the focus is on it.
import type { Context } from '../../actions/context';
import type { Command } from '../../model/commands';

export function trying({ trial }: Context, command: Command) {
  const begin = () => trial.begin(command);
  const stop = () => trial.stop();
  return { onPointerEnter: begin, onPointerLeave: stop, onFocus: begin, onBlur: stop };
}
