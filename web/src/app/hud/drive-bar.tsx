// While a road user is driven: its time, what the keys do, and the two ways to end it.
import { useComputed } from '@preact/signals';
import { num } from '../../model/base/units';
import type { LiveDrive } from '../../edit/tools/driving/live-drive';
import { useApp } from '../parts/app-context';
import { KeyCaps } from '../parts/buttons';
import { TEXTS } from '../../texts/editing/driving';

const KEYS = [
  [['W'], TEXTS.faster],
  [['S'], TEXTS.brake],
  [['A', 'D'], TEXTS.steer],
  [['Space'], TEXTS.brakeHard],
] as const;

export function DriveBar() {
  const drive = useApp().driving.open.value;
  return drive ? <Bar drive={drive} /> : null;
}

function Bar({ drive }: { readonly drive: LiveDrive }) {
  const time = useComputed(() => (void drive.frames.value, num(drive.time, 1)));
  const words = useComputed(() => {
    if (!drive.moves.value) return drive.time ? TEXTS.pressToGoOn : TEXTS.pressToStart;
    return drive.event.value || TEXTS.secondsOf(time.value, num(drive.most, 0));
  });
  return (
    <div class="card drivebar" role="group" aria-label={TEXTS.controls} data-moves={drive.moves.value ? '' : undefined}>
      <b>{words}</b>
      <div class="sep" />
      {KEYS.map(([keys, does]) => (
        <span key={does}>
          {keys.map((k) => (
            <KeyCaps key={k} of={k} />
          ))}
          {does}
        </span>
      ))}
      <div class="sep" />
      <button type="button" class="btn line" onClick={() => void drive.keep()}>
        {TEXTS.keep}
        <KeyCaps of="Enter" />
      </button>
      <button type="button" class="btn" onClick={() => drive.cancel()}>
        {TEXTS.cancel}
        <KeyCaps of="Esc" />
      </button>
    </div>
  );
}
