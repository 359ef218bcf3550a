// Filling an area: density, kinds, and adding it with one key.
import { useComputed } from '@preact/signals';
import type { ComponentChildren, ComponentProps } from 'preact';
import { FILL_KINDS, shareOf, type FillKind } from '../../edit/tools/filling/fill-mix';
import { RATE_STEP } from '../../edit/tools/filling/arm-handles';
import { ANY_SPEED, LEAST_DENSITY, MOST_DENSITY, type EntryArm } from '../../edit/tools/filling/filling';
import { comesLater, type Newcomer } from '../../model/document/newcomer';
import { KIND_NAMES } from '../../model/base/kinds';
import { STEP_S } from '../../model/base/motion';
import { densityText, fromUnit, nextSpeedUnit, num, seconds, speedText, toUnit } from '../../model/base/units';
import { useApp } from '../parts/app-context';
import { SeedField } from '../parts/asking';
import { ActionButton, KeyCaps } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { NumberField } from '../parts/number-field';
import { Slider } from '../parts/slider';
import { Switch } from '../parts/switch';
import '../../styles/filling.css';
import { TEXTS } from '../../texts/panels/fill-panel';

const NAMES: Record<FillKind, string> = {
  car: TEXTS.cars,
  heavy: TEXTS.trucksBuses,
  motorcycle: TEXTS.motorcycles,
  cyclist: TEXTS.cyclists,
  pedestrian: TEXTS.pedestrians,
};
/** Largest weight of a kind in the mix. */
const MOST_WEIGHT = 100;

export default function FillPanel() {
  const { editor, filling } = useApp();
  const size = useComputed(() => filling.all.value.length).value;
  const wish = filling.wish.value;
  if (!wish) return null;
  return (
    <section class="card placing filling" aria-label={TEXTS.fillAnArea} aria-busy={filling.asking.value}>
      <h3>
        {TEXTS.fillAnArea}
        <button type="button" class="btn i" aria-label={TEXTS.close} onClick={() => editor.chooseTool('select')}>
          <Icon name="x" size={16} />
        </button>
      </h3>
      <div class="busy">
        <Share
          label={TEXTS.density}
          value={wish.density}
          range={[LEAST_DENSITY, MOST_DENSITY]}
          step={0.5}
          text={densityText(wish.density)}
          set={(v) => filling.setDensity(v)}
        />
        <div class="ends" aria-hidden="true">
          <span>{TEXTS.empty}</span>
          <span>{TEXTS.freeFlow}</span>
          <span>{TEXTS.queue}</span>
        </div>
      </div>
      <hr />
      {FILL_KINDS.map((k) => (
        <Share
          key={k}
          label={NAMES[k]}
          value={wish.mix[k]}
          range={[0, MOST_WEIGHT]}
          step={2}
          text={`${Math.round(shareOf(wish.mix, k) * 100)}%`}
          set={(v) => filling.setShare(k, v)}
        />
      ))}
      <Share
        label={TEXTS.parkedCars}
        value={Math.round(wish.parked * 100)}
        range={[0, 100]}
        step={5}
        text={filling.answer.value?.parkingPlaces === 0 ? TEXTS.noRoom : `${Math.round(wish.parked * 100)}%`}
        set={(v) => filling.setParked(v / 100)}
      />
      <Line label={TEXTS.speed}>
        <span class="from-to">
          <SpeedField end={0} />
          {TEXTS.to}
          <SpeedField end={1} />
        </span>
      </Line>
      <Arms />
      <Line label={TEXTS.keepExisting}>
        <Switch
          label={TEXTS.keepExisting}
          on={wish.keep}
          title={wish.keep ? TEXTS.existingStay : TEXTS.unlockedAreRemoved}
          set={(keep) => filling.setKeep(keep)}
        />
      </Line>
      <Line label={TEXTS.seed}>
        <SeedField label={TEXTS.seedOfTheFill} seed={wish.seed} set={(v) => filling.setSeed(v)} />
      </Line>
      <div class="foot">
        <ActionButton id="fill-add" class="pri" icon="">
          {TEXTS.add(String(size))}
        </ActionButton>
        <ActionButton id="fill-shuffle" class="line" size={16}>
          {TEXTS.shuffle}
        </ActionButton>
        <span class="grow" />
        <KeyCaps of="Enter" />
      </div>
      <Note />
      <Preview />
    </section>
  );
}

/** One end of the range of start speeds. */
function SpeedField({ end }: { end: 0 | 1 }) {
  const { editor, filling } = useApp();
  const { speedUnit } = editor.view;
  const mps = (): number => (filling.wish.value?.speeds ?? ANY_SPEED)[end];
  return (
    <NumberField
      label={end ? TEXTS.maximumStartSpeed : TEXTS.minimumStartSpeed}
      field={end ? 'fill-fastest' : 'fill-slowest'}
      unit={() => (end ? speedUnit.value : '')}
      quantity={() => speedUnit.value}
      step={1}
      range={() => [toUnit(ANY_SPEED[0], speedUnit.value), toUnit(ANY_SPEED[1], speedUnit.value)]}
      value={() => toUnit(mps(), speedUnit.value)}
      text={() => speedText(mps(), speedUnit.value)}
      set={(v) => {
        const other = filling.wish.value!.speeds[1 - end];
        const here = fromUnit(v, speedUnit.value);
        // The edited end wins: the other one follows.
        filling.setSpeeds(end ? [Math.min(other, here), here] : [here, Math.max(other, here)]);
      }}
      onUnit={end ? () => editor.view.setUnit(nextSpeedUnit(speedUnit.peek())) : undefined}
    />
  );
}

/** Arrivals of each arm; equal to the handles on the map. */
function Arms() {
  const { filling } = useApp();
  const arms = filling.answer.value?.arms ?? [];
  if (!arms.length) return null;
  return (
    <fieldset class="arms">
      <legend>{TEXTS.arrivals}</legend>
      {arms.map((arm) => (
        <Line key={arm.id} label={arm.title}>
          <RateField arm={arm} />
        </Line>
      ))}
    </fieldset>
  );
}

function RateField({ arm }: { arm: EntryArm }) {
  const { filling } = useApp();
  const rate = (): number => filling.wish.value?.rates[arm.id] ?? 0;
  return (
    <NumberField
      label={TEXTS.vehiclesAnHour(arm.title)}
      field={`fill-arm-${arm.id}`}
      unit={() => '/h'}
      quantity={() => 'count'}
      step={RATE_STEP}
      range={() => [0, arm.most]}
      value={rate}
      text={() => String(rate())}
      set={(v) => filling.setRate(arm.id, Math.round(v))}
    />
  );
}

/** The preview for screen readers: a button for each road user, which pins it. */
function Preview() {
  const { filling } = useApp();
  const all = filling.all.value;
  return (
    <div class="sr" role="group" aria-label={TEXTS.preview(all.length)}>
      {all.map((n, i) => (
        <button
          key={comesLater(n) ? `later ${i}` : `${n.pose.x} ${n.pose.y}`}
          type="button"
          tabIndex={-1}
          data-preview={n.kind}
          aria-pressed={filling.isPinned(n)}
          onClick={() => filling.togglePin(n)}
        >
          {TEXTS.at(KIND_NAMES[n.kind], num(n.pose.x, 1), num(n.pose.y, 1))}
          {what(n)}
        </button>
      ))}
    </div>
  );
}

const what = (n: Newcomer): string =>
  n.parked ? TEXTS.parked : comesLater(n) ? TEXTS.arrivesAt(seconds(n.motion!.first * STEP_S)) : '';

/** The next step, or why fewer were placed. */
function Note() {
  const { filling } = useApp();
  const wish = filling.wish.value!;
  const gone = filling.answer.value?.replaced.length ?? 0;
  const reason = filling.answer.value?.reason;
  const pinned = wish.pinned.length;
  const words = filling.drawn.value
    ? TEXTS.clickMoreCorners
    : (reason ??
      (pinned
        ? TEXTS.pinnedShuffle(pinned)
        : Object.values(wish.rates).some((r) => r > 0)
          ? TEXTS.dragAnArrow
          : wish.region
            ? TEXTS.dragACornerTo
            : TEXTS.theWholeMapDraw));
  return (
    <p class="note" aria-live="polite">
      {gone ? TEXTS.removed(gone) : ''}
      {words}
    </p>
  );
}

function Share({ text, ...slider }: ComponentProps<typeof Slider>) {
  return (
    <label class="slide">
      <span>{slider.label}</span>
      <Slider {...slider} text={text} />
      <b>{text}</b>
    </label>
  );
}

function Line({ label, children }: { label: string; children: ComponentChildren }) {
  return (
    <div class="line">
      <span>{label}</span>
      {children}
    </div>
  );
}
