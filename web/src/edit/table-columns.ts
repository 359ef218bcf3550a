// Tables of others: which of their columns says what, and in which unit. The server asks where it cannot tell.
/** A unit as people call it, and how it is told to the server. */
import { TEXTS } from '../texts/files/imports';

interface Unit {
  readonly label: string;
  /** The server's column, where it is not that of the question. */
  readonly field?: string;
  readonly unit?: string;
  readonly factor?: number;
}

/** What is to be known of a table. */
export interface Asked {
  readonly field: string;
  readonly label: string;
  readonly says: string;
  readonly needed: boolean;
  /** Names that others give it. */
  readonly names: RegExp;
  readonly units: readonly Unit[];
}

const LENGTHS: readonly Unit[] = [
  { label: TEXTS.metres },
  { label: TEXTS.centimetres, unit: 'cm' },
  { label: TEXTS.kilometres, unit: 'km' },
  { label: TEXTS.feet, unit: 'ft' },
];

export const ASKED: readonly Asked[] = [
  {
    field: 'agent_id',
    label: TEXTS.who,
    says: TEXTS.numberOrName,
    needed: true,
    names: /^(track|agent|object|obj|vehicle|veh|actor|user|person|ped)?[ _]?(id|name|number|no)$/i,
    units: [],
  },
  {
    field: 'time_s',
    label: TEXTS.when,
    says: TEXTS.theMomentOfA,
    needed: true,
    names: /^(time|t|ts|timestamp|frame|frame[ _]?id|seconds?|global[ _]?time)([ _]?(s|ms|us|ns))?$/i,
    units: [
      { label: TEXTS.seconds },
      { label: TEXTS.milliseconds, unit: 'ms' },
      { label: TEXTS.microseconds, unit: 'us' },
      { label: TEXTS.nanoseconds, unit: 'ns' },
      { label: TEXTS.pictures10ASecond, field: 'step' },
      { label: TEXTS.pictures25ASecond, factor: 1 / 25 },
      { label: TEXTS.pictures30ASecond, factor: 1 / 30 },
    ],
  },
  {
    field: 'x_m',
    label: TEXTS.whereX,
    says: TEXTS.toTheEast,
    needed: true,
    names: /^(pos(ition)?[ _]?x|x|(local|center|centre|global|utm)[ _]?x|x[ _]?(center|centre|pos|m|utm)|easting)$/i,
    units: LENGTHS,
  },
  {
    field: 'y_m',
    label: TEXTS.whereY,
    says: TEXTS.toTheNorth,
    needed: true,
    names: /^(pos(ition)?[ _]?y|y|(local|center|centre|global|utm)[ _]?y|y[ _]?(center|centre|pos|m|utm)|northing)$/i,
    units: LENGTHS,
  },
  {
    field: 'heading_rad',
    label: TEXTS.heading,
    says: TEXTS.fromTheEastTo,
    needed: false,
    names: /^(heading|yaw|psi|psi[ _]?rad|orientation|theta|angle)([ _]?(rad|deg))?$/i,
    units: [{ label: TEXTS.degrees, unit: 'deg' }, { label: TEXTS.radians }],
  },
  {
    field: 'speed_mps',
    label: TEXTS.speed,
    says: TEXTS.whereThereIs,
    needed: false,
    names: /^(speed|velocity|v|v[ _]?vel)([ _]?(m[ _]?s|mps|kmh))?$/i,
    units: [
      { label: 'm/s' },
      { label: 'km/h', unit: 'km/h' },
      { label: 'mph', unit: 'mph' },
      { label: TEXTS.ftS, unit: 'ft/s' },
    ],
  },
  {
    field: 'type',
    label: TEXTS.kind,
    says: TEXTS.carTruckPedestrian,
    needed: false,
    names: /^(agent|object|vehicle|veh|v|track)?[ _]?(type|class|category|kind)$/i,
    units: [],
  },
  {
    field: 'length_m',
    label: TEXTS.length,
    says: TEXTS.alongItsHeading,
    needed: false,
    names: /^(v[ _]?)?length([ _]?m)?$/i,
    units: LENGTHS,
  },
  {
    field: 'width_m',
    label: TEXTS.width,
    says: TEXTS.acrossItsHeading,
    needed: false,
    names: /^(v[ _]?)?width([ _]?m)?$/i,
    units: LENGTHS,
  },
];

/** What a person says: the column, and which of the units. */
export interface Answer {
  readonly column: string | null;
  readonly unit: number;
}
export type Answers = Readonly<Record<string, Answer>>;

/** What the names of the columns let one think, each column once. */
export function guessed(columns: readonly string[]): Answers {
  const left = new Set(columns);
  const all: Record<string, Answer> = {};
  for (const { field, names, units } of ASKED) {
    const column = [...left].find((n) => names.test(n) || names.test(spaced(n))) ?? null;
    if (column) left.delete(column);
    all[field] = { column, unit: column ? unitIn(column, units) : 0 };
  }
  return all;
}

/** `xCenter`: `x_center` */
const spaced = (name: string): string => name.replace(/([a-z])([A-Z])/g, '$1_$2').toLowerCase();

const ENDINGS: Record<string, readonly string[]> = {
  ms: [TEXTS.milliseconds],
  us: [TEXTS.microseconds],
  ns: [TEXTS.nanoseconds],
  rad: [TEXTS.radians],
  deg: [TEXTS.degrees],
  kmh: ['km/h'],
  cm: [TEXTS.centimetres],
  ft: [TEXTS.feet, TEXTS.ftS],
};

function unitIn(column: string, units: readonly Unit[]): number {
  const name = spaced(column);
  if (/^frame/.test(name))
    return Math.max(
      0,
      units.findIndex((u) => u.label === TEXTS.pictures25ASecond),
    );
  const words = ENDINGS[/[ _]([a-z]+)$/.exec(name)?.[1] ?? ''] ?? [];
  return Math.max(
    0,
    units.findIndex((u) => words.includes(u.label)),
  );
}

export const complete = (answers: Answers): boolean => ASKED.every((a) => !a.needed || answers[a.field]?.column);

/** The answers as the server takes them. */
export function toldColumns(answers: Answers): Record<string, unknown> {
  const told: Record<string, unknown> = {};
  for (const { field, units } of ASKED) {
    const { column, unit } = answers[field] ?? { column: null, unit: 0 };
    if (!column) continue;
    const { field: other = field, unit: name, factor } = units[unit] ?? {};
    told[other] = { column, ...(name ? { unit: name } : {}), ...(factor ? { factor } : {}) };
  }
  return told;
}
