// Facts of the generator about a future: faults, relations to others, manoeuvre.
import type { FaultJson, FaultKind, Manoeuvre, ModeJson, RelationJson, RelationKind } from './scene-json';
import type { Vec } from '../base/geometry';

export type { FaultKind, Manoeuvre, RelationKind };

/** A fault of a motion. Times in seconds of the scene. */
export interface Fault {
  readonly kind: FaultKind;
  readonly time: number;
  readonly until: number;
  /** Position of the road user at the worst moment, in metres. */
  readonly at: Vec;
  /**
   * In the unit of its kind: m/s (collision, red light, speeding, running), m/s² (braking, steering), radians (askew),
   * else metres.
   */
  readonly extent: number | null;
  /** The other road user. */
  readonly with: string | null;
  /** Id of the crossed road edge; null where there is none, or the generator does not give it. */
  readonly edge: string | null;
}

export interface Relation {
  readonly kind: RelationKind;
  readonly with: string;
  /** When it is where their ways meet. */
  readonly time: number;
  /** That place, metres. */
  readonly at: Vec;
  /** Time between the two there, seconds; null where one of them never arrives. */
  readonly gap: number | null;
}

export interface FutureFacts {
  /** The worst first. */
  readonly faults: readonly Fault[];
  readonly relations: readonly Relation[];
  readonly manoeuvre: Manoeuvre | null;
}

export const NOTHING_SAID: FutureFacts = { faults: [], relations: [], manoeuvre: null };

/** All kinds, the worst first. */
export const FAULT_KINDS: readonly FaultKind[] = [
  'collision',
  'red_light',
  'wrong_way',
  'over_median',
  'off_road',
  'off_map',
  'on_carriageway',
  'speeding',
  'harsh_braking',
  'harsh_steering',
  'running',
  'askew',
  'fails_to_yield',
  'forces_braking',
  'near_miss',
  'via_missed',
  'goal_missed',
];

/** A future has one mark, the worst of its verdicts; `ok` without faults. */
export type Mark = 'collision' | 'rule' | 'near' | 'short' | 'ok';

const MARKS: readonly Mark[] = ['collision', 'rule', 'near', 'short', 'ok'];

const KIND_MARKS: Partial<Record<FaultKind, Mark>> = {
  collision: 'collision',
  near_miss: 'near',
  via_missed: 'short',
  goal_missed: 'short',
};
const kindMark = (kind: FaultKind): Mark => KIND_MARKS[kind] ?? 'rule';

export const faultMark = (f: Pick<Fault, 'kind'>): Mark => kindMark(f.kind);

export const markOf = (about: FutureFacts): Mark => (about.faults.length ? faultMark(about.faults[0]) : 'ok');

/** Below 0: the first is worse. */
export const compareMarks = (a: Mark, b: Mark): number => MARKS.indexOf(a) - MARKS.indexOf(b);

/** The same of the worst faults of two futures: of two violations one may be the worse kind. */
export const compareFaults = ({ faults: [a] }: FutureFacts, { faults: [b] }: FutureFacts): number => {
  const rank = (f: Fault | undefined): number => (f ? FAULT_KINDS.indexOf(f.kind) : FAULT_KINDS.length);
  return rank(a) - rank(b);
};

/** Does it leave the area of its kind: over a median, off the road, against the traffic? */
export const leavesRoad = (f: Pick<Fault, 'kind'>): boolean =>
  f.kind === 'over_median' || f.kind === 'off_road' || f.kind === 'wrong_way';

/** Null where the generator gives no facts. */
export function readAbout(m: Pick<ModeJson, 'faults' | 'relations' | 'manoeuvre'>): FutureFacts | null {
  if (!m.faults && !m.relations && !m.manoeuvre) return null;
  const faults = (m.faults ?? []).filter((f) => FAULT_KINDS.includes(f.kind)).map(readFault);
  const rank = (f: Fault): number => FAULT_KINDS.indexOf(f.kind);
  return {
    faults: faults.sort((a, b) => rank(a) - rank(b) || a.time - b.time),
    relations: (m.relations ?? []).map(readRelation),
    manoeuvre: m.manoeuvre ?? null,
  };
}

const readRelation = (r: RelationJson): Relation => ({
  kind: r.kind,
  with: r.with,
  time: r.time_s,
  at: [r.x_m, r.y_m],
  gap: r.gap_s ?? null,
});

const readFault = (f: FaultJson): Fault => ({
  kind: f.kind,
  time: f.time_s,
  until: Math.max(f.time_s, f.until_s),
  at: [f.x_m, f.y_m],
  extent: f.extent ?? null,
  with: f.with ?? null,
  edge: f.edge ?? null,
});

/** The unchanged facts, for saving a scene with its futures. */
export interface SentAbout {
  readonly faults?: FaultJson[];
  readonly relations?: RelationJson[];
  readonly manoeuvre?: Manoeuvre;
}

export const sentAbout = ({ faults, relations, manoeuvre }: ModeJson): SentAbout => ({
  ...(faults ? { faults } : {}),
  ...(relations ? { relations } : {}),
  ...(manoeuvre ? { manoeuvre } : {}),
});
