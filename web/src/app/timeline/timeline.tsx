// Transport controls, behaviour of the others, and the speed plot.
import { useComputed } from '@preact/signals';
import { figure, num } from '../../model/base/units';
import { useApp } from '../parts/app-context';
import { MenuButton } from '../menu';
import { IconButton } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { useOthersWord } from '../parts/others';
import { Plot } from './plot';
import { TEXTS } from '../../texts/panels/timeline';

export function Timeline() {
  const { editor, form, signalEdges, variants } = useApp();
  const sheet = form.sheet.value;
  const some = useComputed(() => editor.reading.events.value.length > 0).value;
  const curves = useComputed(
    () =>
      editor.selected.value.length > 0 ||
      editor.selectedEvent.value !== null ||
      editor.view.beside.value !== null ||
      variants.comparing.compared.value !== null,
  ).value;
  const phases = useComputed(() => signalEdges.lanes.value.length > 0).value;
  const others = useOthersWord();
  return (
    <footer
      class="time"
      aria-label={TEXTS.timeline}
      data-group="timeline"
      data-low={curves || sheet ? undefined : ''}
      data-phases={phases ? '' : undefined}
    >
      <div class="tb">
        <IconButton id="play" class="playing" after={<Icon name="pause" size={18} />} />
        {sheet ? <Scrubber /> : null}
        <Clock />
        <RateButton />
        {some || sheet ? <IconButton id="next-event" /> : null}
        {curves || sheet ? <IconButton id="tall-timeline" /> : null}
        <span class="grow" />
        <MenuButton name="others" icon="down" label={`${TEXTS.others} ${others}`}>
          <span class="mut">{`${TEXTS.others} `}</span>
          {others}
        </MenuButton>
      </div>
      <Plot />
    </footer>
  );
}

function Clock() {
  const { editor, following } = useApp();
  // A run that is followed may outlast its scene.
  const run = useComputed(() => following.run.value?.time.value ?? 0);
  const now = useComputed(() => `${num(run.value || editor.playhead.time.value, 1)} s `);
  const end = useComputed(() => (run.value ? '' : `/ ${num(editor.resting.value?.duration ?? 9, 1)} s`));
  return (
    <span class="tm">
      {now}
      <small>{end}</small>
    </span>
  );
}

/** On touch devices the playhead has a separate slider. */
function Scrubber() {
  const { editor } = useApp();
  const end = useComputed(() => editor.resting.value?.duration ?? 9);
  const now = useComputed(() => editor.playhead.time.value.toFixed(1));
  return (
    <input
      type="range"
      class="scrub"
      aria-label={TEXTS.time}
      min={0}
      max={end as never}
      step={0.1}
      value={now}
      style={useComputed(() => `--fill: ${(100 * editor.playhead.time.value) / end.value}%`)}
      onInput={(e) => {
        editor.playhead.pause();
        editor.playhead.moveTo(Number(e.currentTarget.value));
      }}
    />
  );
}

/** The speed of playback, and the menu of everything else about it. */
function RateButton() {
  const { playhead } = useApp().editor;
  const rate = figure(playhead.rate.value);
  return (
    <MenuButton name="playback" icon="down" label={TEXTS.playbackSpeedTimes(rate)} class="rate">
      {rate}×
    </MenuButton>
  );
}
