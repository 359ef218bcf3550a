// Another way that the scene could go, dashed: whoever does another thing there, and the way that it takes.
import { motionOf } from '../model/changes';
import { poseAt } from '../model/motion';
import { startPose } from '../model/scene';
import { paintGhost } from '../draw/handles';
import type { Pen } from '../draw/pen';
import { trail } from '../draw/strokes';
import { colours } from '../draw/theme';
import type { View } from '../draw/view';
import type { Beside } from './editor';

const WAY_DASH = [6, 5];
const BOX_DASH = [4, 3];

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
