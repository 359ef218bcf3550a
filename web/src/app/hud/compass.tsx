// The compass, shown while north is not up: a click resets the turn, a drag turns the picture.
import { useComputed, useSignal } from '@preact/signals';
import { deg, rad, wrapAngle } from '../../model/base/geometry';
import { useApp } from '../parts/app-context';
import { IconButton } from '../parts/buttons';
import { viewTick } from './view-tick';

/** A shorter movement is a click, pixels. */
const START_PX = 4;
/** Within this of north the picture snaps to it. */
const STICKS_RAD = rad(3);

/** A drag of the compass: its start in pixels and as an angle, and the picture's turn then. */
interface Hold {
  readonly x: number;
  readonly y: number;
  readonly angle: number;
  readonly turn: number;
  readonly turning: boolean;
}

function angleOn(e: PointerEvent & { readonly currentTarget: HTMLElement }): number {
  const { left, top, width, height } = e.currentTarget.getBoundingClientRect();
  return Math.atan2(e.clientY - top - height / 2, e.clientX - left - width / 2);
}

export function Compass() {
  const { stage } = useApp();
  const { view, glide } = stage;
  const hold = useSignal<Hold | null>(null);
  const turn = useComputed(() => (void viewTick.value, view.turn)).value;
  // It stays during a drag, even when the picture passes north.
  if (!turn && !hold.value?.turning) return null;
  const down = (e: PointerEvent & { readonly currentTarget: HTMLElement }) => {
    hold.value = { x: e.clientX, y: e.clientY, angle: angleOn(e), turn: view.turn, turning: false };
  };
  const move = (e: PointerEvent & { readonly currentTarget: HTMLElement }) => {
    const from = hold.peek();
    if (!from) return;
    if (!from.turning) {
      if (Math.hypot(e.clientX - from.x, e.clientY - from.y) < START_PX) return;
      // From here on it is a drag and not a click.
      e.currentTarget.setPointerCapture(e.pointerId);
      hold.value = { ...from, turning: true };
      glide.stop();
    }
    // Pixels count downwards.
    const to = wrapAngle(from.turn - (angleOn(e) - from.angle));
    view.turnTo(Math.abs(to) < STICKS_RAD ? 0 : to);
    stage.viewChanged();
  };
  const end = () => (hold.value = null);
  return (
    <div
      class="card compass"
      onPointerDown={down}
      onPointerMove={move}
      onPointerUp={end}
      onPointerCancel={end}
      onPointerLeave={() => {
        if (!hold.peek()?.turning) end();
      }}
    >
      <IconButton id="north-up" icon="">
        <svg viewBox="0 0 20 20" width={24} height={24} style={{ rotate: `${-deg(turn)}deg` }} aria-hidden="true">
          <path class="n" d="M10 1l3.800 9H6.200z" />
          <path class="s" d="M10 19l3.800-9H6.200z" />
        </svg>
      </IconButton>
    </div>
  );
}
