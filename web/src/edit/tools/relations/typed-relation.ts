// Reads a typed relation: "12 m ahead of Car 1 at 5 s, 4 m/s slower, one lane left". The order of its parts does not
// matter, and words that say nothing are skipped.
import { RELATION } from '../../../model/base/domain';
import { figure, fromUnit, type SpeedUnit } from '../../../model/base/units';
import type { Agent, Scene } from '../../../model/document/scene';
import type { GoalRelationJson } from '../../../model/document/scene-json';
import type { Command } from '../../../model/document/commands';
import { dependence, relate } from '../../moves/relating';
import type { Editor } from '../../session/editor';
import { TEXTS } from '../../../texts/editing/relation';

/** A relation, and the goal time where one was typed; or why there is none. */
export type TypedRelation =
  | { readonly relation: GoalRelationJson; readonly time: number | null; readonly why?: undefined }
  | { readonly why: string };

/** What a number counts, and how much of it is one metre, second or m/s. */
const UNITS: Readonly<Record<string, readonly [of: 'length' | 'time' | 'speed', per: number]>> = {
  m: ['length', 1],
  ft: ['length', 0.3048],
  s: ['time', 1],
  ...Object.fromEntries(
    (['m/s', 'km/h', 'mph', 'ft/s'] as const).map((unit: SpeedUnit) => [unit, ['speed', fromUnit(1, unit)]]),
  ),
};

const COUNTS = ['one', 'two', 'three', 'four'] as const;
type Key = keyof typeof TEXTS.words;

/** The name of another road user, for an example; empty where there is none. */
export const otherName = (scene: Scene, own: Agent): string =>
  [...scene.agents.values()].find((a) => a.id !== own.id)?.name ?? '';

/** The name of another road user in a text, and the text without it. The longest counts: "Car 12" has "Car 1" in it. */
function nameIn(text: string, scene: Scene, own: Agent): { readonly to: Agent; readonly rest: string } | null {
  const low = text.toLowerCase();
  const goesOn = (at: number): boolean => /[\p{L}\d]/u.test(low[at] ?? ' ');
  let best: { to: Agent; at: number } | null = null;
  for (const to of scene.agents.values()) {
    const at = low.indexOf(to.name.toLowerCase());
    if (at < 0 || to.id === own.id || goesOn(at + to.name.length)) continue;
    if (!best || to.name.length > best.to.name.length) best = { to, at };
  }
  if (!best) return null;
  const { to, at } = best;
  return { to, rest: `${low.slice(0, at)} ${low.slice(at + to.name.length)}` };
}

interface Parts {
  readonly keys: ReadonlySet<Key>;
  /** Distances in metres, times and time of the goal in seconds, speeds in m/s, numbers without a unit. */
  readonly lengths: readonly number[];
  readonly times: readonly number[];
  readonly due: readonly number[];
  readonly speeds: readonly number[];
  readonly counts: readonly number[];
}

/** The numbers and the known words of a text. */
function partsOf(text: string): Parts {
  const means = (word: string): Key[] =>
    (Object.keys(TEXTS.words) as Key[]).filter((key) => TEXTS.words[key].split('|').includes(word));
  const keys = new Set<Key>();
  const found = { length: [] as number[], time: [] as number[], speed: [] as number[] };
  const [due, counts]: [number[], number[]] = [[], []];
  const tokens = text.replace(/\u2212/g, '-').match(/-?\d+(?:[.,]\d+)?|[\p{L}/]+/gu) ?? [];
  tokens.forEach((token, i) => {
    const number = Number(token.replace(',', '.'));
    if (!Number.isNaN(number)) {
      const unit = UNITS[tokens[i + 1] ?? ''];
      if (!unit) counts.push(number);
      else if (unit[0] === 'time' && i > 0 && means(tokens[i - 1]).includes('at')) due.push(number);
      else found[unit[0]].push(number * unit[1]);
      return;
    }
    for (const key of means(token)) {
      keys.add(key);
      const count = (COUNTS as readonly string[]).indexOf(key);
      if (count >= 0) counts.push(count + 1);
    }
  });
  return { keys, lengths: found.length, times: found.time, speeds: found.speed, due, counts };
}

type RelationPlace = { ahead_m: number } | { behind_m: number } | { behind_s: number } | { after_s: number };

/** Where or when: exactly one distance, or one time that is not the goal's. */
function placeOf({ keys, lengths, times }: Parts): RelationPlace | null {
  if (lengths.length + times.length !== 1) return null;
  const [length, time] = [lengths[0], times[0]];
  if (keys.has('behind')) return length === undefined ? { behind_s: time } : { behind_m: length };
  if (length !== undefined) return keys.has('ahead') ? { ahead_m: length } : null;
  if (keys.has('after')) return { after_s: time };
  return keys.has('before') ? { after_s: -time } : null;
}

const RANGES = {
  ahead_m: [RELATION.gap_m, 'm'],
  behind_m: [RELATION.gap_m, 'm'],
  behind_s: [RELATION.gap_s, 's'],
  after_s: [RELATION.after_s, 's'],
  slower_mps: [RELATION.slower_mps, 'm/s'],
  lanes_left: [RELATION.lanes_left, ''],
} as const;

/** Why a value is refused; null where all are possible. */
function outside(relation: GoalRelationJson): string | null {
  for (const [name, [[least, most], unit]] of Object.entries(RANGES)) {
    const value = relation[name as keyof typeof RANGES];
    if (value != null && (value < least || value > most))
      return TEXTS.outsideOf(`${figure(least)} ${unit}`.trim(), `${figure(most)} ${unit}`.trim());
  }
  return null;
}

export function readRelation(text: string, scene: Scene, own: Agent): TypedRelation {
  const named = nameIn(text, scene, own);
  if (!named) return { why: TEXTS.nameAnother(otherName(scene, own)) };
  const parts = partsOf(named.rest);
  const place = placeOf(parts);
  if (!place) return { why: TEXTS.sayWhere };
  const relation: GoalRelationJson = { to: named.to.id, ...place };
  const { keys, speeds, counts, due } = parts;
  if (!('after_s' in place)) {
    const [speed] = speeds;
    if (speed && (keys.has('slower') || keys.has('faster'))) relation.slower_mps = keys.has('faster') ? -speed : speed;
    const side = keys.has('left') ? 1 : keys.has('right') ? -1 : 0;
    if (side) relation.lanes_left = side * Math.round(counts[0] ?? 1);
  }
  const why = outside(relation) ?? dependence(scene, own, named.to);
  return why === null ? { relation, time: due[0] ?? null } : { why };
}

/** The command of a typed relation, or why there is none. */
export function relationCommand(e: Editor, a: Agent, words: string): Command | string {
  const read = readRelation(words, e.scene.peek()!, a);
  if (read.why !== undefined) return read.why;
  return relate(e, a, read.relation, read.time, words) ?? TEXTS.setPlace;
}
