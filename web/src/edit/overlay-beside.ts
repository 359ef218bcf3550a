// Another way that the scene could go, dashed: whoever does another thing there, and the way that it takes.
import { motionOf } from '../model/changes';
import { poseAt } from '../model/motion';
import { sameSpec, startPose, type Agent, type Scene } from '../model/scene';
import { seconds, speedLabel, type SpeedUnit } from '../model/units';
import { paintFlag, paintGhost } from '../draw/handles';
import { tag, type Labels } from '../draw/labels';
import type { Pen } from '../draw/pen';
import { trail } from '../draw/strokes';
import { colours } from '../draw/theme';
import type { View } from '../draw/view';
import type { Beside } from './editor';

const WAY_DASH = [6, 5];
const BOX_DASH = [4, 3];
const TRIED_DASH = [8, 6];

export function paintBeside(g: Pen, v: View, { scene, set, parted }: Beside, time: number): void {
  const c = colours();
  const all = parted.flatMap((id) => scene.agents.get(id) ?? []);
  for (const a of all)
    trail(g, v, motionOf(scene, set, a), { colour: c['ink-2'], width: 1.5, alpha: 0.8, dash: WAY_DASH, cap: 'butt' });
  for (const a of all) {
    const p = (time < 0.05 ? startPose(a) : null) ?? poseAt(motionOf(scene, set, a), time);
    if (p) paintGhost(g, v, a, p, c.ink, null, BOX_DASH, 1.6);
  }
}

/** What the document there says otherwise: start and goal of whoever is changed, dashed, with the new values. */
export function paintTried(
  g: Pen,
  v: View,
  labels: Labels,
  { scene, set, parted }: Beside,
  now: Scene,
  unitOf: (a: Agent) => SpeedUnit,
): void {
  const c = colours();
  for (const id of parted) {
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
