// Moves the selected road user out from under an opening sheet, by the least distance.
import type { Opening } from '../../actions/context';
import { FLAG } from '../../draw/handles';
import type { View } from '../../draw/view';
import { poseShown } from '../../edit/overlay/frame';
import { boxOf, type OnLine, type Vec } from '../../model/base/geometry';
import type { Agent } from '../../model/document/scene';
import { endShown, whenItsEndIsKnown } from '../look';

/** Nearer to the edge of the sheet than this a road user counts as covered, pixels. */
const EDGE_PX = 20;

type AgentsInSight = readonly (readonly [Agent, OnLine])[];

export function keepInSight(c: Opening): void {
  const { editor, stage } = c;
  stage.covered.listen((before) => {
    const ids = editor.selected.peek();
    const seen = shownOf(c, ids).some(([, p]) => before.shows(p.x, p.y));
    // A road user that is dragged at once stays under the pointer.
    queueMicrotask(() => {
      if (!seen || editor.drag.active.peek()) return;
      panTo(c, ids);
      whenItsEndIsKnown(c, ids, () => panTo(c, ids));
    });
  });
}

function shownOf({ editor }: Opening, ids: readonly string[]): AgentsInSight {
  const agents = editor.scene.peek()?.agents;
  return ids.flatMap((id) => {
    const a = agents?.get(id);
    const p = a && poseShown(editor, a);
    return p ? [[a, p] as const] : [];
  });
}

/** With its flag, if both fit. */
function panTo(c: Opening, ids: readonly string[]): void {
  const { editor, stage } = c;
  const all = shownOf(c, ids);
  if (!all.length) return;
  const v = stage.view.copy();
  v.look(stage.glide.end);
  const { cx, cy } = v;
  const bodies = all.flatMap(([a, p]) => around(v, p, a.length / 2));
  const end = all.length === 1 ? endShown(editor, all[0][0]) : null;
  if (!end || !v.panInto(boxOf([...bodies, ...flagAt(v, end)]), EDGE_PX)) v.panInto(boxOf(bodies), EDGE_PX);
  if (v.cx !== cx || v.cy !== cy) stage.glide.to(v.camera);
}

function around(v: View, p: OnLine, metres: number): readonly Vec[] {
  const [x, y] = v.to(p.x, p.y);
  const r = metres * v.z;
  return [
    [x - r, y - r],
    [x + r, y + r],
  ];
}

function flagAt(v: View, end: Vec): readonly Vec[] {
  const [x, y] = v.to(...end);
  return [
    [x, y],
    [x + FLAG.width * v.grip, y - FLAG.height * v.grip],
  ];
}
