// Going to an event brings it into view, however it was selected.
import { describe, expect, it, vi } from 'vitest';
import { goToEvent, time } from '../../src/actions/time';
import type { Context } from '../../src/actions/context';
import { View } from '../../src/draw/view';
import type { TrafficEvent } from '../../src/model/words/event-words';

const event = (x: number, y: number, time: number) =>
  ({ at: [x, y], time, inLog: false, kind: 'near' }) as unknown as TrafficEvent;

/** The page as far as events need it: a picture of 1000 by 600 pixels, ten to a metre, with a drawer on its left. */
function page(events: TrafficEvent[]) {
  const view = Object.assign(new View(), { w: 1000, h: 600, z: 10, cx: 0, cy: 0 });
  view.inset = { ...view.inset, left: 300 };
  const now = { time: 0, picked: null as TrafficEvent | null };
  const c = {
    editor: {
      reading: { events: { value: events } },
      selectedEvent: {
        get value() {
          return now.picked;
        },
      },
      playhead: {
        pause: vi.fn(),
        moveTo: (t: number) => (now.time = t),
        time: {
          get value() {
            return now.time;
          },
        },
      },
      pickEvent: (e: TrafficEvent) => (now.picked = e),
    },
    stage: { view, glide: { by: (move: (v: View) => void) => move(view) } },
    ui: { showEvents: vi.fn() },
  } as unknown as Context;
  return { c, view, now };
}

describe('going to an event', () => {
  it('keeps a picture that shows it', () => {
    const { c, view, now } = page([]);
    goToEvent(c, event(10, 5, 3));
    expect([view.cx, view.cy, now.time]).toEqual([0, 0, 3]);
  });

  it('brings it out from under a panel and from outside the picture, by key too', () => {
    const hidden = event(-30, 0, 2);
    const beyond = event(400, 90, 5);
    const { c, view, now } = page([hidden, beyond]);
    const next = time.find((a) => a.id === 'next-event')!;
    for (const e of [hidden, beyond, hidden]) {
      next.run(c);
      expect(now.picked).toBe(e);
      expect(view.isClear(e.at[0], e.at[1], 60)).toBe(true);
    }
  });
});
