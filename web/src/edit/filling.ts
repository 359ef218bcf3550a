// A map filled with road users, as the server places them.
import type { AgentJson } from '../model/json';
import { PLACED_KINDS } from '../model/kinds';
import type { Newcomer } from '../model/newcomer';
import { kindOf } from '../model/read';
import { castJson } from '../model/write';
import { Refused, type Client } from '../net/client';
import type { Editor } from './editor';
import type { SceneFile } from './scene-file';
import { addThem, tooMany } from './several';

/** About so many are put on a map. */
const USUAL = 40;

/** Fills a map. Where somebody is there already it asks first. */
export async function fill(editor: Editor, file: SceneFile, client: Client, sure = false): Promise<void> {
  const scene = editor.scene.peek();
  if (!scene || !file.raw) return;
  if (scene.agents.size && !sure) {
    const action = { label: `Add ${USUAL}`, run: () => void fill(editor, file, client, true) };
    editor.notices.show({ text: `Put about ${USUAL} more road users on the map?`, action });
    return;
  }
  const full = tooMany(scene, 1);
  if (full) {
    editor.notices.show({ text: full });
    return;
  }
  const count = Math.min(USUAL, 256 - scene.agents.size);
  const map = file.mapRef ? { ref: file.mapRef } : file.map!;
  const about = file.holds(scene)
    ? { scene_id: scene.id }
    : { scene: { ...file.raw, agents: castJson(scene), map, generated: null } };
  editor.notices.show({ text: 'Looking for places …' });
  try {
    const { agents, reason } = await client.place({ ...about, seed: scene.seed, density: { count } });
    const now = editor.scene.peek();
    if (now?.id !== scene.id) return;
    const all = agents.flatMap((a) => newcomerOf(a) ?? []);
    if (all.length) editor.run(addThem(now, all, 'placed'));
    if (reason) editor.notices.show({ text: `${all.length} road users placed. ${reason}`, undo: all.length > 0 });
  } catch (e) {
    const why = e instanceof Refused ? e.message : 'the server is not answering.';
    editor.notices.show({ text: `Nobody placed: ${why}` });
  }
}

/** A road user that the server placed; null for one of a kind that is only shown. */
function newcomerOf(json: AgentJson): Newcomer | null {
  const kind = PLACED_KINDS.find((k) => k === kindOf(json));
  const { track, conditions } = json;
  const s = conditions?.start;
  const x = s?.x_m ?? track.x_m[0],
    y = s?.y_m ?? track.y_m[0];
  if (!kind || x === undefined || y === undefined) return null;
  const speed = s?.speed_mps ?? Math.hypot(track.vx_mps?.[0] ?? 0, track.vy_mps?.[0] ?? 0);
  return {
    kind,
    subtype: json.subtype ?? null,
    length: json.length_m,
    width: json.width_m,
    pose: { x, y, heading: s?.heading_rad ?? track.heading_rad[0] ?? 0, speed },
    goal: null,
    note: '',
    does: null,
  };
}
