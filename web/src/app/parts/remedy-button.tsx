// A way out as a button: pointed at it shows what comes of it, pressed it is one step. Of an event's it is known before.
import type { Remedy } from '../../edit/moves';
import { useApp } from './app-context';
import { Icon } from './icons';
import { trying } from './trying';

export function RemedyButton({ remedy }: { remedy: Remedy }) {
  const c = useApp();
  const { label, note, icon, primary, command } = remedy;
  const outcome = c.weighing.of(remedy);
  return (
    <button
      type="button"
      class={`opt ${primary ? 'pri' : ''}`}
      data-remedy={label}
      title={outcome?.words}
      {...trying(c, command)}
      onClick={() => c.editor.run(command)}
    >
      <Icon name={icon} size={15} />
      {label}
      {note ? <small>{note}</small> : null}
      {outcome ? (
        <span class={`mk ${outcome.mark}`} role="img" aria-label={outcome.words}>
          <Icon name={`mark-${outcome.mark}`} size={15} />
        </span>
      ) : null}
    </button>
  );
}
