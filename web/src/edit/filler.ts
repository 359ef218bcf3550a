// Asks the server who would stand where, as often as the wish changes, and adds them when that is wanted.
import { effect } from '@preact/signals-core';
import { insidePolygon, type Vec } from '../model/geometry';
import { startPose, type Scene } from '../model/scene';
import type { AgentJson } from '../model/json';
import { PLACED_KINDS } from '../model/kinds';
import { settle, type Newcomer } from '../model/newcomer';
import { canMove } from '../model/scene';
import { kindOf } from '../model/read';
import { castJson, wholeAgentJson } from '../model/write';
import { inOneStep, removeAgents } from '../model/commands';
import { Away, Refused, type Client } from '../net/client';
import type { Editor } from './editor';
import { recast, thinned, typesOf } from './fill-mix';
import type { FillAnswer, FillWish } from './filling';
import { inTheWay, standing } from './room';
import type { SceneFile } from './scene-file';
import { MOST_AT_ONCE, addThem, tooMany } from './several';
import { TEXTS } from '../texts/keeping';

/** A slider that moves asks when it rests so long. */
const REST_MS = 80;
/** Road users for each kilometre of lane, from those for each 100 m. */
const PER_KM = 10;
/** A hand-drawn line may lie so far beyond the map, metres. */
const MARGIN_M = 45;

export class Filler {
  #rest: ReturnType<typeof setTimeout> | undefined;
  #abort: AbortController | null = null;

  constructor(
    private readonly editor: Editor,
    private readonly file: SceneFile,
    private readonly client: Client,
  ) {
    let asked = '';
    effect(() => {
      const wish = editor.filling.wish.value;
      const scene = editor.scene.value;
      clearTimeout(this.#rest);
      if (!wish || !scene) {
        asked = '';
        this.#abort?.abort();
        return;
      }
      // Whoever is pinned stands where the answer had it already: nothing changes until something else does.
      const { pinned, ...rest } = wish;
      const now = JSON.stringify([rest, scene.id, scene.roster]);
      if (now === asked) return;
      asked = now;
      editor.filling.ask();
      this.#rest = setTimeout(() => void this.#ask(scene, { ...rest, pinned }), REST_MS);
    });
  }

  async #ask(scene: Scene, wish: FillWish): Promise<void> {
    const { filling } = this.editor;
    this.#abort?.abort();
    const abort = (this.#abort = new AbortController());
    try {
      const answer = await this.#answer(scene, wish, abort.signal);
      if (!abort.signal.aborted) filling.settle(answer);
    } catch (e) {
      if (abort.signal.aborted) return;
      const reason = e instanceof Refused ? e.message : TEXTS.theGenerator;
      if (!(e instanceof Refused) && !(e instanceof Away)) throw e;
      filling.settle({ all: [], reason, replaced: [] });
    }
  }

  async #answer(scene: Scene, wish: FillWish, signal: AbortSignal): Promise<FillAnswer> {
    const { file } = this;
    const replaced = wish.keep ? [] : replaceable(scene, wish.region);
    const pins = wish.pinned.map((n, i) => wholeAgentJson(settle(n, `pinned-${i + 1}`)));
    const gone = new Set(replaced);
    const there = castJson(scene).filter((a) => !gone.has(a.id));
    const map = file.mapRef ? { ref: file.mapRef } : file.map!;
    const body = {
      scene: { ...file.raw!, agents: [...there, ...pins], map, generated: null },
      seed: wish.seed,
      density: { per_lane_km: wish.density * PER_KM },
      types: typesOf(wish.mix),
      ...(wish.region ? { region: { polygon_m: within(scene, wish.region) } } : {}),
    };
    const { agents, reason } = await this.client.place(body, signal);
    const stay = standing(scene).filter((f) => !gone.has(f.agent.id));
    const taken = [...stay, ...wish.pinned];
    const drawn = agents.flatMap((a) => newcomerOf(a) ?? []).filter((n) => !inTheWay(n, taken));
    const all = recast(withoutThoseOf(wish.pinned, drawn), wish.mix, taken);
    const most = MOST_AT_ONCE - wish.pinned.length;
    if (all.length <= most) return { all, reason, replaced };
    const why = TEXTS.theGeneratorWorks(MOST_AT_ONCE);
    return { all: thinned(all, most), reason: why, replaced };
  }

  /** What is previewed comes into the scene: one step. */
  add(): void {
    const { editor } = this;
    const { filling, notices } = editor;
    const scene = editor.scene.peek();
    const answer = filling.answer.peek();
    const all = filling.all.peek();
    if (!scene || !answer || filling.asking.peek()) return;
    const gone = answer.replaced.filter((id) => scene.agents.has(id));
    const full = tooMany(scene, all.length - gone.length);
    if (full || !all.length) {
      notices.show({ text: full ?? answer.reason ?? TEXTS.thereIsNoRoom });
      return;
    }
    editor.playhead.pause();
    editor.setTime(0);
    const come = addThem(scene, all, 'placed');
    editor.chooseTool('select');
    editor.run(gone.length ? inOneStep(removeAgents(scene, gone, ''), come, come.name) : come);
    if (answer.reason) notices.show({ text: TEXTS.roadUsersPlaced(all.length, answer.reason), undo: true });
  }
}

/** Those in the area who may go: neither locked nor only to be looked at. */
function replaceable(scene: Scene, region: readonly Vec[] | null): string[] {
  return [...scene.agents.values()]
    .filter((a) => {
      const p = startPose(a);
      return canMove(a) && p && (!region || insidePolygon(p.x, p.y, region));
    })
    .map((a) => a.id);
}

/** For each that is pinned one of its kind is taken away, so that there are as many as without pins. */
function withoutThoseOf(pinned: readonly Newcomer[], drawn: readonly Newcomer[]): Newcomer[] {
  const left = [...drawn];
  for (const p of pinned) {
    const i = left.findLastIndex((n) => n.kind === p.kind);
    if (left.length) left.splice(i < 0 ? left.length - 1 : i, 1);
  }
  return left;
}

/** The corners, drawn in to where the server takes them. */
function within({ map: { box } }: Scene, region: readonly Vec[]): Vec[] {
  const inside = (v: number, lo: number, hi: number): number => Math.min(hi + MARGIN_M, Math.max(lo - MARGIN_M, v));
  return region.map(([x, y]) => [inside(x, box.x0, box.x1), inside(y, box.y0, box.y1)] as const);
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
