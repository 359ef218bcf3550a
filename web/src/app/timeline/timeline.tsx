// Transport controls, what is worked out, what the others do, and the speed plot.
import { useComputed } from '@preact/signals';
import { LENGTHS, REPLANS } from '../../model/document/scene';
import { figure, num } from '../../model/base/units';
import { useApp } from '../parts/app-context';
import { IconButton, Segments } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { useOthers } from '../parts/others';
import { Plot } from './plot';
import { TEXTS } from '../../texts/panels/timeline';

export function Timeline() {
  const { form } = useApp();
  const others = useOthers();
  return (
    <footer class="time" aria-label={TEXTS.timeline} data-group="timeline">
      <div class="tb">
        <IconButton id="to-start" />
        <IconButton id="play" class="playing" after={<Icon name="pause" size={18} />} />
        <IconButton id="to-end" />
        {form.sheet.value ? <Scrubber /> : null}
        <Clock />
        <RateButton />
        <IconButton id="loop" />
        <IconButton id="next-event" />
        <IconButton id="tall-timeline" />
        <span class="grow" />
        <Choice name={TEXTS.length} label={TEXTS.howMuchIsWorked} items={seconds('length', LENGTHS)} />
        <Choice name={TEXTS.planAnew} label={TEXTS.howOftenEverybody} items={seconds('replan', REPLANS)} />
        <Choice name={TEXTS.others} label={TEXTS.whatTheOthers} items={others} />
      </div>
      <Plot />
    </footer>
  );
}

type Items = readonly (readonly [string, string])[];

/** What is chosen, by name, and from what; they stay side by side where the line is broken. */
function Choice({ name, label, items }: { name: string; label: string; items: Items }) {
  return (
    <span class="choice">
      <span class="fieldlab">{name}</span>
      <Segments label={label} items={items} />
    </span>
  );
}

/** Seconds side by side; the unit stands once, at the end. */
const seconds = (action: string, all: readonly number[]): Items =>
  all.map((s, i) => [`${action}-${s}`, i === all.length - 1 ? `${s} s` : `${s}`]);

function Clock() {
  const { editor } = useApp();
  const now = useComputed(() => `${num(editor.time.value, 1)} s `);
  const end = useComputed(() => `/ ${num(editor.resting.value?.duration ?? 9, 1)} s`);
  return (
    <span class="tm">
      {now}
      <small>{end}</small>
    </span>
  );
}

/** Where fingers are the hand, the playhead has a rail of its own. */
function Scrubber() {
  const { editor } = useApp();
  const end = useComputed(() => editor.resting.value?.duration ?? 9);
  const now = useComputed(() => editor.time.value.toFixed(1));
  return (
    <input
      type="range"
      class="scrub"
      aria-label={TEXTS.time}
      min={0}
      max={end as never}
      step={0.1}
      value={now}
      style={useComputed(() => `--fill: ${(100 * editor.time.value) / end.value}%`)}
      onInput={(e) => {
        editor.playhead.pause();
        editor.setTime(Number(e.currentTarget.value));
      }}
    />
  );
}

function RateButton() {
  const { playhead } = useApp().editor;
  const rate = playhead.rate.value;
  return (
    <button
      type="button"
      class="btn rate"
      title={TEXTS.playbackSpeed}
      aria-label={TEXTS.playbackSpeedTimes(figure(rate))}
      onClick={(e) => playhead.changeRate(e.shiftKey ? -1 : 1, true)}
    >
      {figure(rate)}×
    </button>
  );
}
