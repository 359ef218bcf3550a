// Positions of seconds and speeds in the plot.
import { inTenths, type SpeedUnit, toUnit, walkingUnit } from '../../model/base/units';
import { motionOf } from '../../model/physics/playback';
import type { TrafficEvent } from '../../model/words/event-words';
import type { Motion } from '../../model/base/motion';
import { untracked } from '@preact/signals';
import type { Agent } from '../../model/document/scene';
import type { Context } from '../../actions/context';
import { TEXTS } from '../../texts/panels/timeline';

/** Pixels left of the plot, right of it, for the events above and for the seconds below. */
export const X0 = 52;
const RIGHT = 22;
export const LANE = 24;
const BOTTOM = 20;

export interface PlotSize {
  readonly w: number;
  readonly h: number;
}

export interface Axes {
  readonly x: (t: number) => number;
  readonly y: (v: number) => number;
  readonly x1: number;
  readonly y0: number;
  readonly y1: number;
  readonly height: number;
  /** The speed at the upper edge, in `unit`. */
  readonly top: number;
  readonly unit: SpeedUnit;
  readonly duration: number;
}

export function axesOf(c: Context, { w, h }: PlotSize): Axes {
  const { editor } = c;
  const several = severalShown(c);
  const agent = several.length ? null : editor.agent.peek();
  const onFoot = several.length > 0 && several.every((l) => l.agent.type === 'pedestrian');
  const unit = agent
    ? editor.view.unitOf(agent)
    : onFoot
      ? walkingUnit(editor.view.speedUnit.peek())
      : editor.view.speedUnit.peek();
  const duration = editor.scene.peek()?.duration ?? 9;
  const x1 = w - RIGHT;
  const y0 = LANE + 6;
  const y1 = h - BOTTOM;
  const top = topSpeedShown(c, unit);
  return {
    x: (t) => X0 + ((x1 - X0) * t) / duration,
    y: (v) => y1 - ((y1 - y0) * Math.min(top, Math.max(0, v))) / top,
    x1,
    y0,
    y1,
    height: h,
    top,
    unit,
    duration,
  };
}

/** Is the plot high enough for curves? Without any it has only events and seconds. */
export const hasCurves = (a: Axes): boolean => a.y1 - a.y0 > 20;

/** More lines than this would be a grey patch. */
const MOST_LINES = 40;

/** A road user and the motion with the shown speeds. */
export interface SpeedLine {
  readonly agent: Agent;
  readonly motion: Motion;
}

/** The viewed event; null with a selection, whose speeds are shown instead. */
export const eventShown = ({ editor }: Context): TrafficEvent | null =>
  editor.selected.peek().length ? null : editor.selectedEvent.peek();

/** Events in the plot: for two variants those of both, each with its number. */
export function eventsShown(c: Context): readonly TrafficEvent[] {
  if (c.layouts.isNew.peek()) return [];
  const both = c.variants.comparing.compared.peek();
  if (!both) return c.editor.reading.shownEvents.peek();
  const who = c.variants.comparing.followed.peek()?.agent.id;
  return [both.left, both.right]
    .flatMap(({ id, events }) =>
      events
        .filter((e) => !e.inLog && (e.a.id === who || e.b?.id === who))
        .map((e) => ({ ...e, label: TEXTS.inVariant(id, e.label) })),
    )
    .sort((p, q) => p.time - q.time);
}

/**
 * Lines of the plot: the compared road user in both variants, the road users of a viewed case or event, or several
 * selected ones.
 */
export function severalShown(c: Context): SpeedLine[] {
  const { editor } = c;
  const both = c.variants.comparing.followed.peek();
  if (both) return [both.left, both.right].map((motion) => ({ agent: both.agent, motion }));
  const b = editor.view.beside.peek();
  const inCase = b?.meeting?.who.flatMap((id) => b.scene.agents.get(id) ?? []);
  if (b && inCase) return inCase.map((agent) => ({ agent, motion: motionOf(b.scene, b.set, agent) }));
  const event = eventShown(c);
  if (event) {
    const who = [event.a, event.b].flatMap((a) => editor.scene.peek()?.agents.get(a?.id ?? '') ?? []);
    return untracked(() => who.map((agent) => ({ agent, motion: editor.reading.motionFor(agent) })));
  }
  return editor.selected.peek().length > 1 && !editor.drag.active.peek()
    ? untracked(() =>
        editor.chosenOnes.slice(0, MOST_LINES).map((agent) => ({ agent, motion: editor.reading.motionFor(agent) })),
      )
    : [];
}

/** A round figure above all shown speeds. */
function topSpeedShown(c: Context, unit: SpeedUnit): number {
  const { editor } = c;
  const log = editor.agent.peek()?.log;
  const several = severalShown(c).map((l) => l.motion);
  const motions: Motion[] = [
    ...several,
    ...(log ? [log] : []),
    ...(editor.reading.futures.peek()?.modes.map((m) => m.motion) ?? []),
  ];
  let max = 0;
  for (const m of motions) for (const v of m.speed) max = Math.max(max, toUnit(Math.abs(v), unit));
  const steps = inTenths(unit) ? [2, 4, 8, 16, 32] : [20, 40, 60, 80, 120, 160, 220];
  return steps.find((s) => s >= max * 1.02) ?? steps[steps.length - 1];
}

/** Half of a sign without words, and the space between two in the lane, in pixels. */
export const SIGN = 10;
const APART = 3;

/** A sign in the lane of events. It is at its time; its words are where there is room. */
export interface PlacedSign {
  /** Index of the shown item, and of all that share its sign because they are close in time. */
  readonly item: number;
  readonly items: readonly number[];
  readonly x: number;
  readonly words: 'right' | 'left' | null;
}

export interface EventSign {
  /** Position of its time, in pixels. */
  readonly at: number;
  /** Width of its words. */
  readonly w: number;
  /** The lower, the worse. */
  readonly rank: number;
}

/** Signs in order of time; overlapping ones share the sign of the worst. */
export function placeSigns(items: readonly EventSign[], from: number, to: number): PlacedSign[] {
  const groups: { item: number; items: number[] }[] = [];
  items.forEach(({ at, rank }, i) => {
    const last = groups.at(-1);
    if (!last || at - items[last.item].at >= 2 * SIGN + APART) groups.push({ item: i, items: [i] });
    else {
      last.items.push(i);
      if (rank < items[last.item].rank) last.item = i;
    }
  });
  let taken = from;
  return groups.map(({ item, items: all }, k) => {
    const { at, w } = items[item];
    const next = k + 1 < groups.length ? items[groups[k + 1].item].at - SIGN - APART : to;
    const right = at + SIGN + w <= next;
    const left = !right && at - SIGN - w >= taken;
    taken = at + SIGN + APART + (right ? w : 0);
    return { item, items: all, x: at, words: right ? 'right' : left ? 'left' : null };
  });
}

/** Seconds marked behind the curves from `time` to `until`: wide enough to be visible, within the plot. */
export function markedSpan(time: number, until: number, least: number, duration: number): [number, number] {
  const extra = Math.max(0, least - (until - time)) / 2;
  const from = Math.max(0, time - extra);
  return [Math.min(from, duration), Math.min(duration, until + extra)];
}
