// Converts the server's answer to a placement: which road users would stand where, and which are shown.
import { deg, insidePolygon, wrapAngle, type Vec } from '../../../model/base/geometry';
import type { AgentJson } from '../../../model/document/scene-json';
import { PLACED_KINDS, kindOf } from '../../../model/base/kinds';
import { isStill, motionFrom } from '../../../model/base/motion';
import { comesLater, settle, type Newcomer } from '../../../model/document/newcomer';
import { canMove, startPose, type Scene } from '../../../model/document/scene';
import { armTitles } from '../../../model/words/arm-titles';
import { castJson, timedJson, wholeAgentJson } from '../../../model/document/scene-writer';
import type { Client } from '../../../net/client';
import type { PlaceReply } from '../../../net/types';
import { typesOf } from './fill-mix';
import { recast, thinned } from './fill-recast';
import { ANY_SPEED, type EntryArm, type FillAnswer, type FillWish } from './filling';
import { inTheWay, standing } from '../../moves/room';
import type { SceneFile } from '../../document/scene-file';
import { MOST_AT_ONCE } from '../../moves/several';
import { TEXTS } from '../../../texts/editing/filling';

/** Road users for each kilometre of lane, from those for each 100 m. */
const PER_KM = 10;
/** A drawn outline may extend this far beyond the map, metres. */
const MARGIN_M = 45;

export class FillAnswers {
  /** The arms of the last requested place; their names are valid only there. */
  #known: { readonly place: string; readonly arms: readonly string[] } = { place: '', arms: [] };

  constructor(
    private readonly file: SceneFile,
    private readonly client: Client,
  ) {}

  async to(scene: Scene, wish: FillWish, signal: AbortSignal): Promise<FillAnswer> {
    const { file } = this;
    const replaced = wish.keep ? [] : replaceable(scene, wish.region);
    const pins = wish.pinned.map((n, i) => wholeAgentJson(settle(n, `pinned-${i + 1}`)));
    const gone = new Set(replaced);
    const there = castJson(scene).filter((a) => !gone.has(a.id));
    const map = file.sentMap(scene);
    const [min_mps, max_mps] = wish.speeds;
    const where = {
      scene: { ...file.raw!, ...timedJson(file.raw!, scene), agents: [...there, ...pins], map, generated: null },
      ...(wish.region ? { region: { polygon_m: within(scene, wish.region) } } : {}),
    };
    const body = {
      ...where,
      seed: wish.seed,
      density: { per_lane_km: wish.density * PER_KM },
      types: typesOf(wish.mix),
      ...(min_mps > ANY_SPEED[0] || max_mps < ANY_SPEED[1] ? { speeds: { min_mps, max_mps } } : {}),
      arrivals: await this.#arrivals(scene, wish, where, signal),
      parked: { share: wish.parked },
    };
    const { agents, unplaced, reason, arms, parking_places } = await this.client.place(body, signal);
    const known: readonly EntryArm[] = armsOf(arms);
    this.#known = { place: placeOf(scene, wish), arms: known.map((a) => a.id) };
    const more = { replaced, arms: known, parkingPlaces: parking_places };
    const stay = standing(scene).filter((f) => !gone.has(f.agent.id));
    const taken = [...stay, ...wish.pinned];
    const drawn = agents.flatMap((a) => newcomerOf(a) ?? []).filter((n) => comesLater(n) || !inTheWay(n, taken));
    // Where the server placed fewer than requested, pinned ones take the missing places first.
    const all = recast(withoutThoseOf(wish.pinned.slice(unplaced), drawn), wish.mix, taken);
    const most = MOST_AT_ONCE - wish.pinned.length;
    if (all.length <= most) return { ...more, all, reason };
    const why = TEXTS.generatorComputes(MOST_AT_ONCE);
    return { ...more, all: thinned(all, most), reason: why };
  }

  /** The requested traffic, limited to existing arms. */
  async #arrivals(
    scene: Scene,
    wish: FillWish,
    where: object,
    signal: AbortSignal,
  ): Promise<{ arm: string; per_hour: number }[]> {
    const rates = Object.entries(wish.rates).filter(([, perHour]) => perHour > 0);
    if (!rates.length) return [];
    const place = placeOf(scene, wish);
    if (this.#known.place !== place) {
      const { arms } = await this.client.place({ ...where, density: { per_lane_km: 0 } }, signal);
      this.#known = { place, arms: arms.map((a) => a.id) };
    }
    return rates.filter(([arm]) => this.#known.arms.includes(arm)).map(([arm, per_hour]) => ({ arm, per_hour }));
  }
}

const placeOf = (scene: Scene, { region }: FillWish): string => JSON.stringify([scene.id, region]);

function armsOf(arms: PlaceReply['arms']): EntryArm[] {
  // An arm lies where its traffic comes from.
  const titles = armTitles(arms.map((a) => deg(wrapAngle(a.heading_rad + Math.PI))));
  return arms.map((a, i) => ({
    id: a.id,
    title: titles[i],
    at: [a.x_m, a.y_m],
    heading: a.heading_rad,
    most: a.most_per_hour,
    placed: a.placed,
    later: a.later,
  }));
}

/** Road users in the area that may be replaced: neither locked nor read-only. */
function replaceable(scene: Scene, region: readonly Vec[] | null): string[] {
  return [...scene.agents.values()]
    .filter((a) => {
      const p = startPose(a);
      return canMove(a) && p && (!region || insidePolygon(p.x, p.y, region));
    })
    .map((a) => a.id);
}

/** For each of these pinned ones, one of its kind is removed, so that the number stays. */
function withoutThoseOf(pinned: readonly Newcomer[], drawn: readonly Newcomer[]): Newcomer[] {
  const left = [...drawn];
  for (const p of pinned) {
    const i = left.findLastIndex((n) => n.kind === p.kind && n.parked === p.parked && !comesLater(n));
    const other = left.findLastIndex((n) => !n.motion);
    const gone = i < 0 ? other : i;
    if (gone >= 0) left.splice(gone, 1);
  }
  return left;
}

/** The corners, clamped to the range of the server. */
function within({ map: { box } }: Scene, region: readonly Vec[]): Vec[] {
  const inside = (v: number, lo: number, hi: number): number => Math.min(hi + MARGIN_M, Math.max(lo - MARGIN_M, v));
  return region.map(([x, y]) => [inside(x, box.x0, box.x1), inside(y, box.y0, box.y1)] as const);
}

/** A road user that the server placed; null for a kind that cannot be placed. */
function newcomerOf(json: AgentJson): Newcomer | null {
  const kind = PLACED_KINDS.find((k) => k === kindOf(json));
  const { track, conditions } = json;
  const s = conditions?.start;
  const x = s?.x_m ?? track.x_m[0],
    y = s?.y_m ?? track.y_m[0];
  if (!kind || x === undefined || y === undefined) return null;
  // The motion of late arrivals and parked ones comes with the answer.
  const motion = track.x_m.length > 1 || (track.first_step ?? 0) > 0 ? motionFrom(track) : null;
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
    motion,
    parked: motion !== null && motion.first === 0 && isStill(motion),
  };
}
