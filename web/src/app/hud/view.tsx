// Scale and zoom. The view changes many times a second; these follow at most once a frame.
import { useComputed } from '@preact/signals';
import { scaleOf } from '../../draw/scale';
import { HOME_ZOOM } from '../../draw/view';
import { useApp } from '../parts/app-context';
import { IconButton } from '../parts/buttons';
import { viewTick } from './view-tick';
import { TEXTS } from '../../texts/desk/hud';

export function ScaleBar() {
  const { stage } = useApp();
  void viewTick.value;
  const { words, px } = scaleOf(stage.view);
  return (
    <div class="card scale" aria-hidden="true">
      <i style={{ width: `${px}px` }} />
      <span>{words}</span>
    </div>
  );
}

export function ZoomBar() {
  const { stage } = useApp();
  const percent = useComputed(() => (void viewTick.value, `${Math.round((stage.view.z / HOME_ZOOM) * 100)}%`));
  return (
    <div class="br">
      <div class="card chipbar zoom" role="group" aria-label={TEXTS.zoom}>
        <span class="zoomnum">{percent}</span>
        <IconButton id="fit" size={16} />
      </div>
    </div>
  );
}
