// Time: playback, events, planned time.
import { counted } from '../model/physics/events';
import type { TrafficEvent } from '../model/words/event-words';
import { LENGTHS, REPLANS } from '../model/document/scene';
import { setLength, setReplan } from '../model/document/commands';
import { STEP_S } from '../model/base/motion';
import { hasScene, inGroup } from './action';
import type { Context } from './context';
import { TEXTS } from '../texts/desk/actions';
import { TEXTS as COUNTS } from '../texts/panels/thresholds';

function stepBy(c: Context, frames: number): void {
  c.editor.playhead.pause();
  c.editor.playhead.moveTo((Math.round(c.editor.playhead.time.value / STEP_S) + frames) * STEP_S);
}

function goTo(c: Context, seconds: number): void {
  c.editor.playhead.pause();
  c.editor.playhead.moveTo(seconds);
}

/** An event nearer to the edge of the picture than this is centred, in pixels. */
const EDGE_PX = 60;

/** Moves the playhead to an event and the picture to its place; its facts open. */
export function goToEvent(c: Context, e: TrafficEvent): void {
  const { editor, stage, ui } = c;
  goTo(c, e.time);
  editor.pickEvent(e);
  ui.showEvents(true);
  const [x, y] = e.at;
  if (!stage.view.isClear(x, y, EDGE_PX)) stage.glide.by((v) => v.centre(x, y));
}

function nextEvent(c: Context): void {
  const { editor } = c;
  const now = editor.playhead.time.value;
  // Events of the recording are walked only where there are no others.
  const own = counted(editor.reading.events.value);
  const events = own.length ? own : editor.reading.events.value;
  const later = events.find((e) => e.time > now + 0.05 || (e.time >= now && e !== editor.selectedEvent.value));
  const next = later ?? events[0];
  if (next) goToEvent(c, next);
}

const lengths = LENGTHS.map((s) => ({
  id: `length-${s}`,
  label: TEXTS.lengthS(s),
  help: s > 9 ? ('replansAfterNineSeconds' as const) : ('oneWindowOfNineSeconds' as const),
  when: hasScene,
  checked: (c: Context) => c.editor.resting.value?.length === s,
  run(c: Context) {
    const scene = c.editor.scene.peek()!;
    if (scene.length !== s) c.editor.commits.run(setLength(scene, s));
  },
}));

const replans = REPLANS.map((s) => ({
  id: `replan-${s}`,
  label: TEXTS.replanEvery(s),
  help: 'thePlanningWindow' as const,
  when: hasScene,
  checked: (c: Context) => c.editor.resting.value?.replan === s,
  run(c: Context) {
    if (c.editor.scene.peek()!.replan !== s) c.editor.commits.run(setReplan(s));
  },
}));

export const time = inGroup('time', [
  {
    id: 'what-counts',
    label: COUNTS.actionLabel,
    icon: 'warn',
    help: 'thresholdsOfTheScene',
    when: hasScene,
    run: ({ ui }) => ui.showEvents('counts'),
  },
  {
    id: 'play',
    label: TEXTS.playOrPause,
    keys: ['Space'],
    icon: 'play',
    help: 'playsFromThePlayhead',
    when: hasScene,
    checked: (c) => c.editor.playhead.playing.value,
    run: (c) => c.playback.toggle(),
  },
  {
    id: 'step-back',
    label: TEXTS.at01SBack,
    keys: [','],
    help: 'oneFrame',
    when: hasScene,
    run: (c) => stepBy(c, -1),
  },
  {
    id: 'step-on',
    label: TEXTS.at01SForward,
    keys: ['.'],
    help: 'oneFrame',
    when: hasScene,
    run: (c) => stepBy(c, 1),
  },
  {
    id: 'to-start',
    label: TEXTS.toTheStart,
    keys: ['Home'],
    icon: 'prev',
    help: 'playheadTo',
    when: hasScene,
    run: (c) => goTo(c, 0),
  },
  {
    id: 'to-end',
    label: TEXTS.toTheEnd,
    keys: ['End'],
    icon: 'next',
    help: 'playheadToThe',
    when: hasScene,
    run: (c) => goTo(c, Infinity),
  },
  {
    id: 'slower-playback',
    label: TEXTS.slowerPlayback,
    keys: ['Shift+,'],
    help: 'downTo01',
    run: (c) => c.editor.playhead.changeRate(-1),
  },
  {
    id: 'faster-playback',
    label: TEXTS.fasterPlayback,
    keys: ['Shift+.'],
    help: 'upTo8',
    run: (c) => c.editor.playhead.changeRate(1),
  },
  {
    id: 'loop',
    label: TEXTS.loop,
    keys: ['P'],
    icon: 'loop',
    help: 'restartsAtTheEnd',
    checked: (c) => c.editor.playhead.loop.value,
    run: (c) => c.editor.playhead.toggleLoop(),
  },
  {
    id: 'tall-timeline',
    label: TEXTS.tallTimeline,
    keys: ['T'],
    icon: 'pencil',
    help: 'showsTheCurveLarger',
    checked: (c) => c.ui.tall.value,
    run: (c) => c.ui.toggleTall(),
  },
  {
    id: 'next-event',
    label: TEXTS.nextEvent,
    keys: ['E'],
    icon: 'warn',
    help: 'collisionNear',
    when: (c) => (c.editor.reading.events.value.length ? true : TEXTS.noEvents),
    run: nextEvent,
  },
  ...lengths,
  ...replans,
]);
