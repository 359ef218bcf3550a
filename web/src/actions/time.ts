// Time: playback, events, how much is worked out.
import { counted } from '../model/events';
import { LENGTHS, REPLANS } from '../model/scene';
import { setLength, setReplan } from '../model/commands';
import { STEP_S } from '../model/motion';
import { hasScene, inGroup } from './action';
import type { Context } from './context';

function stepBy(c: Context, frames: number): void {
  c.editor.playhead.pause();
  c.editor.setTime((Math.round(c.editor.time.value / STEP_S) + frames) * STEP_S);
}

function goTo(c: Context, seconds: number): void {
  c.editor.playhead.pause();
  c.editor.setTime(seconds);
}

function nextEvent({ editor, ui }: Context): void {
  const now = editor.time.value;
  // What is in the log is no news; it is walked only where there is nothing else.
  const own = counted(editor.events.value);
  const events = own.length ? own : editor.events.value;
  const later = events.find((e) => e.time > now + 0.05 || (e.time >= now && e !== editor.selectedEvent.value));
  const next = later ?? events[0];
  if (!next) return;
  editor.playhead.pause();
  ui.showEvents(true);
  editor.setTime(next.time);
  editor.pickEvent(next);
}

const lengths = LENGTHS.map((s) => ({
  id: `length-${s}`,
  label: `Length ${s} s`,
  help:
    s > 9 ? `Work out ${s} s: past 9 s everybody plans anew from where they are by then` : 'Work out 9 s, in one go',
  when: hasScene,
  checked: (c: Context) => c.editor.resting.value?.length === s,
  run(c: Context) {
    const scene = c.editor.scene.peek()!;
    if (scene.length !== s) c.editor.run(setLength(scene, s));
  },
}));

const replans = REPLANS.map((s) => ({
  id: `replan-${s}`,
  label: `Plan anew each ${s} s`,
  help: `Everybody looks again every ${s} s and plans on from there`,
  when: hasScene,
  checked: (c: Context) => c.editor.resting.value?.replan === s,
  run(c: Context) {
    if (c.editor.scene.peek()!.replan !== s) c.editor.run(setReplan(s));
  },
}));

export const time = inGroup('Time', [
  {
    id: 'play',
    label: 'Play or pause',
    keys: ['Space'],
    icon: 'play',
    help: 'Runs from the playhead',
    when: hasScene,
    checked: (c) => c.editor.playing.value,
    run: (c) => c.playback.toggle(),
  },
  {
    id: 'step-back',
    label: '0.1 s back',
    keys: [','],
    help: 'One frame',
    when: hasScene,
    run: (c) => stepBy(c, -1),
  },
  {
    id: 'step-on',
    label: '0.1 s on',
    keys: ['.'],
    help: 'One frame',
    when: hasScene,
    run: (c) => stepBy(c, 1),
  },
  {
    id: 'to-start',
    label: 'To the start',
    keys: ['Home'],
    icon: 'prev',
    help: 'Playhead to 0.0 s',
    when: hasScene,
    run: (c) => goTo(c, 0),
  },
  {
    id: 'to-end',
    label: 'To the end',
    keys: ['End'],
    icon: 'next',
    help: 'Playhead to the last frame',
    when: hasScene,
    run: (c) => goTo(c, Infinity),
  },
  {
    id: 'slower-playback',
    label: 'Slower playback',
    keys: ['Shift+,'],
    help: 'Down to 0.1×',
    run: (c) => c.editor.playhead.changeRate(-1),
  },
  {
    id: 'faster-playback',
    label: 'Faster playback',
    keys: ['Shift+.'],
    help: 'Up to 8×',
    run: (c) => c.editor.playhead.changeRate(1),
  },
  {
    id: 'loop',
    label: 'Loop',
    keys: ['P'],
    icon: 'loop',
    help: 'Start again at the end',
    checked: (c) => c.editor.playhead.loop.value,
    run: (c) => c.editor.playhead.toggleLoop(),
  },
  {
    id: 'tall-timeline',
    label: 'High timeline',
    keys: ['T'],
    icon: 'pencil',
    help: 'Room for the speed curve: drag its points, double click for one more, Del takes it away',
    checked: (c) => c.ui.tall.value,
    run: (c) => c.ui.toggleTall(),
  },
  {
    id: 'next-event',
    label: 'Next event',
    keys: ['E'],
    icon: 'warn',
    help: 'Collision, near miss or broken rule after the playhead',
    when: (c) => (c.editor.events.value.length ? true : 'There are no events.'),
    run: nextEvent,
  },
  ...lengths,
  ...replans,
]);
