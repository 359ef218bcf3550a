// The handles of the selected road user, for keys and screen readers. They have no picture of their own.
import { useComputed } from '@preact/signals';
import { canMove } from '../../model/document/scene';
import { Later } from '../later';
import { useApp } from '../parts/app-context';
import { TEXTS } from '../../texts/desk/access';

export function HandleSliders() {
  const { editor } = useApp();
  const id = useComputed(() =>
    editor.restingAgent.value && canMove(editor.restingAgent.value) ? editor.selection.value : null,
  );
  return (
    <div class="sr" role="group" aria-label={TEXTS.handles} data-group="handles">
      {id.value ? <Later part="handles" key={id.value} id={id.value} /> : null}
    </div>
  );
}
