// An alternative motion of the scene, dashed: each road user that differs, and its path.
import { motionOf } from '../../model/physics/playback';
import { poseAt } from '../../model/base/motion';
import { sameSpec, startPose, type Agent, type Scene } from '../../model/document/scene';
import { seconds, speedLabel, type SpeedUnit } from '../../model/base/units';
import { paintFlag, paintGhost, paintRing } from '../../draw/handles';
import { tag, type Labels } from '../../draw/labels';
import type { Pen } from '../../draw/pen';
import { colourKey, stamp } from '../../draw/sprites';
import { traceLine, trail } from '../../draw/strokes';
import { colours } from '../../draw/theme';
import type { View } from '../../draw/view';
import type { SceneBeside, Tries } from '../session/view-settings';

const WAY_DASH = [6, 5];
const BOX_DASH = [4, 3];
const TRIED_DASH = [8, 6];
const TRIED_ALPHA = 0.22;
/** The road users of a moment are ringed for this long before and after it. */
const NOW_S = 0.45;

/** Paths tried by a search, all in one thin pale stroke. */
export function paintTries(g: Pen, v: View, tries: Tries): void {
  if (!tries.length) return;
  g.beginPath();
  for (const way of tries) traceLine(g, v, way);
  g.strokeStyle = colours()['ink-2'];
  // Thinner separate strokes overlap, and many would look black.
  g.lineWidth = 1.25;
  g.lineCap = 'round';
  g.lineJoin = 'round';
  g.globalAlpha = TRIED_ALPHA;
  g.stroke();
  g.globalAlpha = 1;
}

export function paintBeside(g: Pen, v: View, { scene, set, diverging }: SceneBeside, time: number): void {
  const c = colours();
  const all = diverging.flatMap((id) => scene.agents.get(id) ?? []);
  for (const a of all)
    trail(g, v, motionOf(scene, set, a), { colour: c['ink-2'], width: 1.5, alpha: 0.8, dash: WAY_DASH, cap: 'butt' });
  for (const a of all) {
    const p = (time < 0.05 ? startPose(a) : null) ?? poseAt(motionOf(scene, set, a), time);
    if (p) paintGhost(g, v, a, p, c.ink, null, BOX_DASH, 1.6);
  }
}

/** The pointed-out moment: rings around its road users, and its words at the place. */
export function paintMeeting(
  g: Pen,
  v: View,
  labels: Labels,
  { scene, set, meeting }: SceneBeside,
  time: number,
): void {
  if (!meeting) return;
  const c = colours();
  // Road users of the moment are drawn in full with their whole path; all others of the case are dashed.
  for (const id of meeting.who) {
    const a = scene.agents.get(id);
    const m = a && motionOf(scene, set, a);
    const p = m && poseAt(m, time);
    if (m) trail(g, v, m, { colour: c[colourKey(a)], width: 2.5, halo: true, dots: true });
    if (p) stamp(g, v, a, p, true);
    g.setTransform(v.dpr, 0, 0, v.dpr, 0, 0);
    if (p) tag(g, labels, v.to(p.x, p.y), a.name, { radii: [26, 38, 52] });
  }
  for (const id of Math.abs(time - meeting.time) < NOW_S ? meeting.who : []) {
    const a = scene.agents.get(id);
    const p = a && poseAt(motionOf(scene, set, a), time);
    if (a && p) paintRing(g, v, a, p, c['near-edge'], 2, 3);
  }
  tag(g, labels, v.to(meeting.at[0], meeting.at[1]), meeting.words, {
    bg: c.near,
    fg: c['on-near'],
    leader: c['near-text'],
    icon: 'triangle',
    radii: [44, 60, 84],
    height: 22,
  });
}

/** What the tried document changes: start and goal of each changed road user, dashed, with the new values. */
export function paintTried(
  g: Pen,
  v: View,
  labels: Labels,
  { scene, set, diverging }: SceneBeside,
  now: Scene,
  unitOf: (a: Agent) => SpeedUnit,
): void {
  const c = colours();
  for (const id of diverging) {
    const [a, was] = [scene.agents.get(id), now.agents.get(id)];
    if (!a || !was || a === was) continue;
    trail(g, v, motionOf(scene, set, a), { colour: c.goal, width: 3, dash: TRIED_DASH, halo: true, dots: true });
    const start = startPose(a);
    if (start && !sameSpec(a.start, was.start)) {
      paintGhost(g, v, a, start, c.select, null, BOX_DASH, 2);
      tag(g, labels, v.to(start.x, start.y), speedLabel(start.speed, unitOf(a)), {
        border: c.ink,
        radii: [30, 44, 60],
      });
    }
    const { pos, heading, speed, time } = a.goal;
    if (!pos || (sameSpec(a.goal, was.goal) && time === was.goal.time)) continue;
    const end = poseAt(motionOf(scene, set, a), time);
    const pose = { x: pos[0], y: pos[1], heading: heading ?? end?.heading ?? start?.heading ?? 0 };
    paintGhost(g, v, a, pose, c.goal, c['goal-soft'], BOX_DASH, 2);
    paintFlag(g, labels, v.to(pos[0], pos[1]), c.goal, true, v.grip);
    const words = [time === was.goal.time ? '' : seconds(time), speed === null ? '' : speedLabel(speed, unitOf(a))];
    const text = words.filter(Boolean).join(' · ');
    if (text) tag(g, labels, v.to(pos[0], pos[1]), text, { fg: c['goal-text'], border: c.goal, radii: [44, 60] });
  }
}
