// Changed motions, one sentence each.
import type { MotionSet } from '../document/futures';
import type { Agent, Scene } from '../document/scene';
import { JUDGING } from '../base/domain';
import { distances, poseAtStep, STEP_S, type Motion } from '../base/motion';
import { num, metres, speedText, walkingUnit, type SpeedUnit } from '../base/units';
import { changesBetween, furthest, type MotionChange } from '../physics/changes';
import type { Reaction } from '../physics/reaction';
import { TEXTS } from '../../texts/scene/reactions';

export interface Change extends MotionChange {
  /** `waits 2 s for Car 7` */
  readonly words: string;
}

/** Road users with a changed motion, except those in `except`, in words; the largest delay first. */
export function findChanges(
  scene: Scene,
  before: MotionSet,
  after: MotionSet,
  except: ReadonlySet<string>,
  unit: SpeedUnit = 'km/h',
): Change[] {
  return changesBetween(scene, before, after, except).map((c) => {
    const alone = c.released ? TEXTS.noLongerReacts(c.released.name) : TEXTS.replanned;
    const words = c.reaction ? reactionWords(scene.agents.get(c.id)!, c.reaction, unit) : alone;
    return { ...c, words };
  });
}

/** Shorter waits than this have no number of seconds. */
const TOLD_S = 0.5;

/** `waits 2 s for Car 7`, `slows to 8 km/h behind Car 12`: the verb first, the other's name last. */
export function reactionWords(a: Agent, r: Reaction, shown: SpeedUnit = 'km/h'): string {
  const { name } = r.cause;
  switch (r.kind) {
    case 'waits': {
      const long = r.delay !== null && r.delay >= TOLD_S ? ` ${roundSeconds(r.delay)} s` : '';
      return TEXTS.waits(long, name, r.ahead);
    }
    case 'slows': {
      const unit = a.type === 'pedestrian' ? walkingUnit(shown) : shown;
      const speed = speedText(Math.abs(r.place.speed), unit);
      return /[1-9]/.test(speed) ? TEXTS.slowsTo(`${speed} ${unit}`, name, r.ahead) : TEXTS.stopsBriefly(name, r.ahead);
    }
    case 'speeds_up':
      return TEXTS.speedsUpFor(name);
    case 'keeps_clear':
      return TEXTS.keepsClearOf(name, r.ahead);
    case 'stays_out':
      return TEXTS.staysOut(name);
  }
}

/** Half seconds below two, whole ones above: tenths of a wait are meaningless. */
function roundSeconds(v: number): string {
  const step = v < 1.75 ? 2 : 1;
  const r = Math.round(v * step) / step;
  return num(r, r % 1 ? 1 : 0);
}

const firstStep = (m: Motion): number => m.valid[0]?.[0] ?? m.first;

/** Words for the recorded ghost: largest distance of the edited road user from its recording, and where. */
export function comparedWithLog(a: Agent, m: Motion, duration: number): { d: number; t: number; words: string } | null {
  if (m === a.log || a.placed) return null;
  const f = furthest(a.log, m, duration);
  if (f.d < 0.3) return null;
  const last = Math.round(duration / STEP_S);
  const end = poseAtStep(m, last),
    log = poseAtStep(a.log, last);
  let words = TEXTS.differs;
  if (end && log) {
    // A recording may begin earlier and end later than the planned time.
    const from = Math.max(firstStep(m), firstStep(a.log));
    const gone = (of: Motion): number => {
      const s = distances(of);
      return s[last - of.first] - (s[from - of.first] ?? 0);
    };
    const [s1, s0] = [gone(m), gone(a.log)];
    const turn = Math.abs(Math.atan2(Math.sin(end.heading - log.heading), Math.cos(end.heading - log.heading)));
    if (turn > JUDGING.turn_rad) words = TEXTS.endsTurned;
    else if (s1 < s0 - 2) words = TEXTS.travelsLess(metres(s0 - s1, 0));
    else if (s1 > s0 + 2) words = TEXTS.travelsMore(metres(s1 - s0, 0));
  }
  return { ...f, words };
}
