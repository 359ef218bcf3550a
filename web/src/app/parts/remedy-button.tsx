// A remedy as a button: hover shows the outcome, a press is one step.
import type { Remedy } from '../../edit/moves/remedies';
import type { Outcome } from '../../edit/asking/remedy-outcomes';
import { useApp } from './app-context';
import { Icon } from './icons';
import { useTrying } from './trying';

/** `outcome`: the outcome, where already known. */
export function RemedyButton({ remedy, outcome }: { remedy: Remedy; outcome?: Outcome }) {
  const { editor } = useApp();
  const { label, note, icon, primary, command } = remedy;
  return (
    <button
      type="button"
      class={`opt ${primary ? 'pri' : ''}`}
      data-remedy={label}
      title={outcome?.words}
      {...useTrying(command)}
      onClick={() => editor.commits.run(command)}
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
