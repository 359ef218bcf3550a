// Why a pinned future no longer answers what is asked of its road user, in words.
import { pinMisfit } from '../document/pins';
import type { Agent, Pin } from '../document/scene';
import { metres, speedLabel, type SpeedUnit } from '../base/units';
import { TEXTS } from '../../texts/editing/pins';

/** `12 m from the goal`; null for a pinned future that fits. */
export function misfit(a: Agent, pin: Pin, unit: SpeedUnit): string | null {
  const m = pinMisfit(a, pin);
  switch (m?.what) {
    case undefined:
      return null;
    case 'kind':
      return TEXTS.anotherKind;
    case 'start':
      return TEXTS.startsAway(metres(m.metres, 1));
    case 'start-heading':
      return TEXTS.startsTurned;
    case 'start-speed':
      return TEXTS.startsAt(speedLabel(m.speed, unit));
    case 'goal':
      return TEXTS.fromTheGoal(metres(m.metres, 0));
    case 'goal-heading':
      return TEXTS.endsTurned;
    case 'goal-speed':
      return TEXTS.endsAt(speedLabel(m.speed, unit));
    case 'via':
      return TEXTS.missesVia;
  }
}
