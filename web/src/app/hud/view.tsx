// Scale and zoom. The view changes many times a second; these follow once a frame at most.
import { useComputed } from '@preact/signals';
import { HOME_ZOOM } from '../../draw/view';
import { useApp } from '../parts/app-context';
import { IconButton } from '../parts/buttons';
import { viewTick } from './view-tick';
import { TEXTS } from '../../texts/hud';

/** The longest the scale gets, in pixels. */
const LONGEST_PX = 90;

export function ScaleBar() {
  const { stage } = useApp();
  void viewTick.value;
  const longest = LONGEST_PX / stage.view.z;
  const power = 10 ** Math.floor(Math.log10(longest));
  const metres = [5, 2, 1].map((k) => k * power).find((v) => v <= longest) ?? power;
  return (
    <div class="card scale" aria-hidden="true">
      <i style={{ width: `${metres * stage.view.z}px` }} />
      <span>{metres} m</span>
    </div>
  );
}

export function ZoomBar() {
  const { stage } = useApp();
  const percent = useComputed(() => (void viewTick.value, `${Math.round((stage.view.z / HOME_ZOOM) * 100)}%`));
  return (
    <div class="br">
      <div class="card chipbar zoom" role="group" aria-label={TEXTS.zoom}>
        <IconButton id="zoom-out" size={16} />
        <span class="zoomnum">{percent}</span>
        <IconButton id="zoom-in" size={16} />
        <IconButton id="fit" size={16} />
      </div>
    </div>
  );
}
