// Where north is, as soon as it is not up: a click turns the picture back.
import { useComputed } from '@preact/signals';
import { deg } from '../../model/geometry';
import { useApp } from '../parts/app-context';
import { IconButton } from '../parts/buttons';
import { viewTick } from './view-tick';

export function Compass() {
  const { stage } = useApp();
  const turn = useComputed(() => (void viewTick.value, stage.view.turn)).value;
  return turn ? (
    <div class="card compass">
      <IconButton id="north-up" icon="">
        <svg viewBox="0 0 20 20" width={24} height={24} style={{ rotate: `${-deg(turn)}deg` }} aria-hidden="true">
          <path class="n" d="M10 1l3.800 9H6.200z" />
          <path class="s" d="M10 19l3.800-9H6.200z" />
        </svg>
      </IconButton>
    </div>
  ) : null;
}
