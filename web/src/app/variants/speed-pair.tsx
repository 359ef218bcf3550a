// How fast somebody goes in the one variant and in the other: two curves over the same time.
import { useComputed, useSignal } from '@preact/signals';
import type { Compared } from '../../edit/variants/cards';
import { poseAt, STEP_S, type Motion } from '../../model/motion';
import { toUnit } from '../../model/units';
import { useApp } from '../parts/app-context';
import { TEXTS } from '../../texts/variants-panel';

const W = 280;
const H = 96;
/** Room for the numbers on the left and below. */
const X0 = 26;
const Y1 = H - 14;
const Y0 = 6;
/** Slower scenes have an axis of their own all the same, in the unit shown. */
const LEAST_TOP = 5;

export function SpeedPair({ now }: { now: Compared }) {
  const { editor } = useApp();
  const { parted } = now.parting;
  const picked = useSignal<string | null>(null);
  const who = parted.find((p) => p.agent.id === picked.value) ?? parted[0];
  const duration = now.left.scene.duration;
  const at = useComputed(() => X0 + (editor.time.value / duration) * (W - X0));
  if (!who) return null;
  const unit = editor.unitOf(who.agent);
  const [left, right] = [who.left, who.right].map((m) => speeds(m, duration).map((v) => v && toUnit(v, unit)));
  const top = Math.max(LEAST_TOP, Math.ceil(Math.max(...[...left, ...right].map((v) => v ?? 0)) / 5) * 5);
  const path = (of: readonly (number | null)[]): string =>
    of
      .map((v, i) => {
        if (v === null) return '';
        const x = X0 + ((i * STEP_S) / duration) * (W - X0);
        const y = Y1 - (v / top) * (Y1 - Y0);
        return `${i && of[i - 1] !== null ? 'L' : 'M'}${x.toFixed(1)} ${y.toFixed(1)}`;
      })
      .join('');
  return (
    <section class="sect speedpair">
      <h3>
        {TEXTS.speed}
        <small>{unit}</small>
      </h3>
      <select
        class="field pick"
        aria-label={TEXTS.whoseSpeed}
        value={who.agent.id}
        onChange={(e) => (picked.value = e.currentTarget.value)}
      >
        {parted.map((p) => (
          <option key={p.agent.id} value={p.agent.id}>
            {p.agent.name}
          </option>
        ))}
      </select>
      <svg viewBox={`0 0 ${W} ${H}`} role="img" aria-label={TEXTS.speedOfInBoth(who.agent.name)}>
        <path d={`M${X0} ${Y0}V${Y1}H${W}`} class="axis" />
        <text x={X0 - 4} y={Y0 + 8} text-anchor="end">
          {top}
        </text>
        <text x={X0 - 4} y={Y1} text-anchor="end">
          0
        </text>
        <text x={W} y={H - 2} text-anchor="end">
          {duration} s
        </text>
        <path d={path(left)} class="left" />
        <path d={path(right)} class="right" />
        <line x1={at} x2={at} y1={Y0} y2={Y1} class="now" />
      </svg>
      <p class="legend">
        <span class="left">{now.left.id}</span>
        <span class="right">{now.right.id}</span>
      </p>
    </section>
  );
}

/** Speeds step by step; null where it is not there. */
function speeds(m: Motion, duration: number): (number | null)[] {
  const n = Math.round(duration / STEP_S) + 1;
  return Array.from({ length: n }, (_, i) => {
    const p = poseAt(m, i * STEP_S);
    return p && Math.abs(p.speed);
  });
}
