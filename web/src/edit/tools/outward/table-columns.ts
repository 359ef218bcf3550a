// Columns of foreign tables: their meaning and unit. The server requests them where it cannot infer them.
/** A unit by its displayed name, and its form for the server. */
import { TEXTS } from '../../../texts/files/imports';

interface Unit {
  readonly label: string;
  /** The server's column, where it differs from the field. */
  readonly field?: string;
  readonly unit?: string;
  readonly factor?: number;
}

/** A quantity to find in a table. */
export interface ColumnQuantity {
  readonly field: string;
  readonly label: string;
  readonly says: string;
  readonly needed: boolean;
  /** Common names of the column. */
  readonly names: RegExp;
  readonly units: readonly Unit[];
}

const LENGTHS: readonly Unit[] = [
  { label: TEXTS.metres },
  { label: TEXTS.centimetres, unit: 'cm' },
  { label: TEXTS.kilometres, unit: 'km' },
  { label: TEXTS.feet, unit: 'ft' },
];

export const ASKED: readonly ColumnQuantity[] = [
  {
    field: 'agent_id',
    label: TEXTS.roadUserColumn,
    says: TEXTS.numberOrName,
    needed: true,
    names: /^(track|agent|object|obj|vehicle|veh|actor|user|person|ped)?[ _]?(id|name|number|no)$/i,
    units: [],
  },
  {
    field: 'time_s',
    label: TEXTS.time,
    says: TEXTS.timeOfTheRow,
    needed: true,
    names: /^(time|t|ts|timestamp|frame|frame[ _]?id|seconds?|global[ _]?time)([ _]?(s|ms|us|ns))?$/i,
    units: [
      { label: TEXTS.seconds },
      { label: TEXTS.milliseconds, unit: 'ms' },
      { label: TEXTS.microseconds, unit: 'us' },
      { label: TEXTS.nanoseconds, unit: 'ns' },
      { label: TEXTS.frames10, field: 'step' },
      { label: TEXTS.frames25, factor: 1 / 25 },
      { label: TEXTS.frames30, factor: 1 / 30 },
    ],
  },
  {
    field: 'x_m',
    label: TEXTS.positionX,
    says: TEXTS.toTheEast,
    needed: true,
    names: /^(pos(ition)?[ _]?x|x|(local|center|centre|global|utm)[ _]?x|x[ _]?(center|centre|pos|m|utm)|easting)$/i,
    units: LENGTHS,
  },
  {
    field: 'y_m',
    label: TEXTS.positionY,
    says: TEXTS.toTheNorth,
    needed: true,
    names: /^(pos(ition)?[ _]?y|y|(local|center|centre|global|utm)[ _]?y|y[ _]?(center|centre|pos|m|utm)|northing)$/i,
    units: LENGTHS,
  },
  {
    field: 'heading_rad',
    label: TEXTS.heading,
    says: TEXTS.fromEast,
    needed: false,
    names: /^(heading|yaw|psi|psi[ _]?rad|orientation|theta|angle)([ _]?(rad|deg))?$/i,
    units: [{ label: TEXTS.degrees, unit: 'deg' }, { label: TEXTS.radians }],
  },
  {
    field: 'speed_mps',
    label: TEXTS.speed,
    says: TEXTS.ifThereIsOne,
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
    label: TEXTS.type,
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

/** The user's answer: the column, and the index of its unit. */
export interface ColumnChoice {
  readonly column: string | null;
  readonly unit: number;
}
export type ColumnChoices = Readonly<Record<string, ColumnChoice>>;

/** Guesses from the column names; each column is used once. */
export function guessed(columns: readonly string[]): ColumnChoices {
  const left = new Set(columns);
  const all: Record<string, ColumnChoice> = {};
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
      units.findIndex((u) => u.label === TEXTS.frames25),
    );
  const words = ENDINGS[/[ _]([a-z]+)$/.exec(name)?.[1] ?? ''] ?? [];
  return Math.max(
    0,
    units.findIndex((u) => words.includes(u.label)),
  );
}

export const complete = (answers: ColumnChoices): boolean => ASKED.every((a) => !a.needed || answers[a.field]?.column);

/** The answers in the form of the server. */
export function toldColumns(answers: ColumnChoices): Record<string, unknown> {
  const told: Record<string, unknown> = {};
  for (const { field, units } of ASKED) {
    const { column, unit } = answers[field] ?? { column: null, unit: 0 };
    if (!column) continue;
    const { field: other = field, unit: name, factor } = units[unit] ?? {};
    told[other] = { column, ...(name ? { unit: name } : {}), ...(factor ? { factor } : {}) };
  }
  return told;
}
