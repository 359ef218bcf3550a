// A signal that increases after each change of the view, at most once a frame.
import { signal, type ReadonlySignal } from '@preact/signals';
import type { Stage } from '../../draw/stage';

const tick = signal(0);
export const viewTick: ReadonlySignal<number> = tick;
const moving = signal(false);
/** Is the picture being animated? */
export const gliding: ReadonlySignal<boolean> = moving;
const turned = signal(0);
/** The picture's turn, outside animations. */
export const turnAtRest: ReadonlySignal<number> = turned;

export function followView(stage: Stage): void {
  let queued = false;
  stage.moved.listen(() => {
    if (queued) return;
    queued = true;
    requestAnimationFrame(() => {
      queued = false;
      tick.value++;
      moving.value = stage.glide.going;
      // Lets scripts convert world points to screen positions.
      const { cx, cy, z, turn } = stage.view.camera;
      if (!stage.glide.going) turned.value = turn;
      stage.element.dataset.view = [cx, cy, z, turn].map((v) => v.toFixed(4)).join(' ');
    });
  });
}
