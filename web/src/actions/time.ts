// Time: playback, events, how much is worked out.
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
  c.editor.setTime((Math.round(c.editor.time.value / STEP_S) + frames) * STEP_S);
}

function goTo(c: Context, seconds: number): void {
  c.editor.playhead.pause();
  c.editor.setTime(seconds);
}

/** An event nearer to the edge of the picture than this is brought to the middle, in pixels. */
const EDGE_PX = 60;

/** The playhead goes to an event and the picture to where it happens; its facts open. */
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
  const now = editor.time.value;
  // What is in the log is no news; it is walked only where there is nothing else.
  const own = counted(editor.events.value);
  const events = own.length ? own : editor.events.value;
  const later = events.find((e) => e.time > now + 0.05 || (e.time >= now && e !== editor.selectedEvent.value));
  const next = later ?? events[0];
  if (next) goToEvent(c, next);
}

const lengths = LENGTHS.map((s) => ({
  id: `length-${s}`,
  label: TEXTS.lengthS(s),
  help: s > 9 ? ('pastNineSeconds' as const) : ('workOutInOneGo' as const),
  when: hasScene,
  checked: (c: Context) => c.editor.resting.value?.length === s,
  run(c: Context) {
    const scene = c.editor.scene.peek()!;
    if (scene.length !== s) c.editor.run(setLength(scene, s));
  },
}));

const replans = REPLANS.map((s) => ({
  id: `replan-${s}`,
  label: TEXTS.planAnewEach(s),
  help: 'looksAgain' as const,
  when: hasScene,
  checked: (c: Context) => c.editor.resting.value?.replan === s,
  run(c: Context) {
    if (c.editor.scene.peek()!.replan !== s) c.editor.run(setReplan(s));
  },
}));

export const time = inGroup('time', [
  {
    id: 'what-counts',
    label: COUNTS.whatCountsAsEvent,
    icon: 'warn',
    help: 'howNearAndHard',
    when: hasScene,
    run: ({ ui }) => ui.showEvents('counts'),
  },
  {
    id: 'play',
    label: TEXTS.playOrPause,
    keys: ['Space'],
    icon: 'play',
    help: 'runsFromThe',
    when: hasScene,
    checked: (c) => c.editor.playing.value,
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
    label: TEXTS.at01SOn,
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
    help: 'startAgain',
    checked: (c) => c.editor.playhead.loop.value,
    run: (c) => c.editor.playhead.toggleLoop(),
  },
  {
    id: 'tall-timeline',
    label: TEXTS.highTimeline,
    keys: ['T'],
    icon: 'pencil',
    help: 'roomForThe',
    checked: (c) => c.ui.tall.value,
    run: (c) => c.ui.toggleTall(),
  },
  {
    id: 'next-event',
    label: TEXTS.nextEvent,
    keys: ['E'],
    icon: 'warn',
    help: 'collisionNear',
    when: (c) => (c.editor.events.value.length ? true : TEXTS.thereAreNoEvents),
    run: nextEvent,
  },
  ...lengths,
  ...replans,
]);
