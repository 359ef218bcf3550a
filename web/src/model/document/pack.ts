// Scenes as little text: columns of numbers as differences of whole numbers, which compress to a fraction. Exact:
// what is unpacked equals what was packed, to the last bit.

/** Marks of packed values; no member of a scene begins so. */
import { TEXTS } from '../../texts/scene/reading';

const COLUMN = '$c',
  POINTS = '$p';
const MOST_DIGITS = 7;
const LEAST_LENGTH = 4;

type Json = unknown;
/** Digits after the point, order of the differences, and these. */
type Column = readonly [digits: number, order: number, ...differences: number[]];

const isNumbers = (v: readonly Json[]): v is number[] => v.every((x) => typeof x === 'number');
const isPoints = (v: readonly Json[]): v is number[][] =>
  v.every((p) => Array.isArray(p) && p.length === (v[0] as Json[]).length && p.length > 1 && isNumbers(p));

export function pack(v: Json): Json {
  if (Array.isArray(v)) return packList(v);
  if (typeof v !== 'object' || v === null) return v;
  return Object.fromEntries(Object.entries(v).map(([k, x]) => [k, pack(x)]));
}

function packList(v: readonly Json[]): Json {
  if (v.length >= LEAST_LENGTH && isNumbers(v)) {
    const c = columnOf(v);
    return c ? { [COLUMN]: c } : v;
  }
  if (v.length >= LEAST_LENGTH && isPoints(v)) {
    const columns = v[0].map((_, i) => columnOf(v.map((p) => p[i])));
    if (columns.every((c) => c !== null)) return { [POINTS]: columns };
  }
  return v.map(pack);
}

/** Null where the numbers are no short decimals. */
function columnOf(v: readonly number[]): Column | null {
  for (let digits = 0; digits <= MOST_DIGITS; digits++) {
    const k = 10 ** digits;
    const whole = v.map((x) => Math.round(x * k));
    if (!whole.every((n, i) => Number.isSafeInteger(n) && Object.is(n / k, v[i]))) continue;
    const once = differences(whole),
      twice = differences(once);
    return length(twice) < length(once) ? [digits, 2, ...twice] : [digits, 1, ...once];
  }
  return null;
}

const differences = (v: readonly number[]): number[] => v.map((x, i) => (i ? x - v[i - 1] : x));
const length = (v: readonly number[]): number => v.reduce((sum, x) => sum + String(x).length, 0);

function sums(v: readonly number[]): number[] {
  let sum = 0;
  return v.map((x) => (sum += x));
}

export class PackError extends Error {}

function readColumn(c: Json): number[] {
  if (!Array.isArray(c) || !isNumbers(c) || c.length < 2) throw new PackError(TEXTS.aColumnIsBroken);
  const [digits, order, ...d] = c as number[];
  if (!(digits >= 0 && digits <= MOST_DIGITS) || (order !== 1 && order !== 2))
    throw new PackError(TEXTS.aColumnIsBroken);
  const whole = order === 2 ? sums(sums(d)) : sums(d);
  const k = 10 ** digits;
  return whole.map((n) => n / k);
}

export function unpack(v: Json): Json {
  if (Array.isArray(v)) return v.map(unpack);
  if (typeof v !== 'object' || v === null) return v;
  if (COLUMN in v) return readColumn(v[COLUMN as keyof typeof v]);
  if (POINTS in v) {
    const columns = (v[POINTS as keyof typeof v] as Json[]).map(readColumn);
    return columns[0].map((_, i) => columns.map((c) => c[i]));
  }
  return Object.fromEntries(Object.entries(v).map(([k, x]) => [k, unpack(x)]));
}
