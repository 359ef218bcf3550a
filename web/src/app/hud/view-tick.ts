// A signal that rises when the view has changed, once a frame at most.
import { signal, type ReadonlySignal } from '@preact/signals';
import type { Stage } from '../../draw/stage';

const tick = signal(0);
export const viewTick: ReadonlySignal<number> = tick;
const moving = signal(false);
/** Is the picture on its way to another place by itself? */
export const gliding: ReadonlySignal<boolean> = moving;
const turned = signal(0);
/** How the picture is turned, where it is not on its way. */
export const turnAtRest: ReadonlySignal<number> = turned;

export function followView(stage: Stage): void {
  let queued = false;
  stage.watchView(() => {
    if (queued) return;
    queued = true;
    requestAnimationFrame(() => {
      queued = false;
      tick.value++;
      moving.value = stage.glide.going;
      // Lets scripts that drive the page find world points on the screen.
      const { cx, cy, z, turn } = stage.view.camera;
      if (!stage.glide.going) turned.value = turn;
      stage.element.dataset.view = [cx, cy, z, turn].map((v) => v.toFixed(4)).join(' ');
    });
  });
}
