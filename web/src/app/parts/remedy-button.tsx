// A way out as a button: pointed at it shows what comes of it, pressed it is one step.
import type { Remedy } from '../../edit/moves';
import { useApp } from './app-context';
import { Icon } from './icons';
import { trying } from './trying';

export function RemedyButton({ remedy: { label, note, icon, primary, command } }: { remedy: Remedy }) {
  const c = useApp();
  return (
    <button
      type="button"
      class={`opt ${primary ? 'pri' : ''}`}
      data-remedy={label}
      {...trying(c, command)}
      onClick={() => c.editor.run(command)}
    >
      <Icon name={icon} size={15} />
      {label}
      {note ? <small>{note}</small> : null}
    </button>
  );
}
