// Under the loupe: the place of the dragged handle.
import { useComputed } from '@preact/signals';
import { useApp } from '../parts/app-context';

export function LoupeWords() {
  const { editor } = useApp();
  const words = useComputed(() => editor.drag.info.value?.lane?.name ?? '').value;
  return words ? (
    <div class="loupewords" aria-hidden="true">
      {words}
    </div>
  ) : null;
}
