// Numbers as displayed and typed. Internally everything is SI.
import { signal } from '@preact/signals-core';
import { LANGUAGE } from '../../texts/language';
import { TEXTS } from '../../texts/scene/places';
import { deg } from './geometry';

export type SpeedUnit = 'km/h' | 'm/s' | 'mph' | 'ft/s';

/** Units for speeds of vehicles. */
const SPEED_UNITS: readonly SpeedUnit[] = ['km/h', 'mph', 'm/s'];
/** The matching unit for pedestrians: metres or feet per second, as in traffic planning. */
export const walkingUnit = (unit: SpeedUnit): SpeedUnit => (unit === 'mph' ? 'ft/s' : 'm/s');
export const nextSpeedUnit = (unit: SpeedUnit): SpeedUnit =>
  SPEED_UNITS[(SPEED_UNITS.indexOf(unit) + 1) % SPEED_UNITS.length];

const FOOT_M = 0.3048;
const PER_MPS: Record<SpeedUnit, number> = { 'km/h': 3.6, 'm/s': 1, mph: 2.2369362920544, 'ft/s': 1 / FOOT_M };
/** Speeds in these larger units are shown with one decimal. */
export const inTenths = (unit: string): boolean => unit === 'm/s' || unit === 'ft/s';

export const toUnit = (mps: number, unit: SpeedUnit): number => mps * PER_MPS[unit];
export const fromUnit = (value: number, unit: SpeedUnit): number => value / PER_MPS[unit];

/** Fixed decimals in the format of the language, with a true minus sign and no negative zero. */
export function num(value: number, decimals = 1): string {
  const text = Math.abs(value).toFixed(decimals);
  return value < 0 && Number(text) !== 0 ? `\u2212${written(text)}` : written(text);
}

/** From five digits on German separates thousands with a narrow no-break space. */
const THOUSANDS = /\B(?=(?:\d{3})+(?:\.|$))(?<!\.\d*)/g;
const written = (text: string): string =>
  LANGUAGE === 'de' ? (/^\d{5}/.test(text) ? text.replace(THOUSANDS, '\u202f') : text).replace('.', ',') : text;

/** A number with its own decimals: `0.25`, `4`. */
export const figure = (value: number): string => written(String(value));

/** Miles per hour imply feet. Positions in the scene stay in metres, as in its files. */
const shown = signal<SpeedUnit>('km/h');
/** Sets the unit of lengths and speeds; returns it, for storing the setting. */
export function toldIn(unit: SpeedUnit): SpeedUnit {
  shown.value = unit;
  return unit;
}

export type LengthUnit = 'm' | 'ft';
export const lengthUnit = (): LengthUnit => (shown.value === 'mph' ? 'ft' : 'm');
/** The unit as a word, for screen readers. */
export const lengthUnitWord = (): string => (lengthUnit() === 'ft' ? TEXTS.feet : TEXTS.metres);
export const toLength = (m: number): number => (lengthUnit() === 'ft' ? m / FOOT_M : m);
/** A typed or scrubbed length, without floating-point residue. */
export const fromLength = (v: number): number => (lengthUnit() === 'ft' ? Number((v * FOOT_M).toFixed(6)) : v);

/** The number of a length given in metres, in the displayed unit. */
export const lengthText = (m: number, decimals = toLength(m) < 10 ? 1 : 0): string => num(toLength(m), decimals);
/** A length given in metres, with its unit. */
export const metres = (m: number, decimals?: number): string => `${lengthText(m, decimals)} ${lengthUnit()}`;
/** Length or width of a road user: below one metre with centimetres. */
export const sizeText = (m: number): string =>
  lengthText(m, lengthUnit() === 'm' && m < 1 && Math.abs(m * 10 - Math.round(m * 10)) > 1e-6 ? 2 : 1);
/** `4.7 × 2.0 m` */
export const areaText = (a: number, b: number, text: (m: number) => string = sizeText): string =>
  `${text(a)} × ${text(b)} ${lengthUnit()}`;

/** The largest of 1, 2, 5, 10, 20, … that is at most the value. */
export function roundBelow(v: number): number {
  const power = 10 ** Math.floor(Math.log10(v) + 1e-9);
  return Number(([5, 2, 1].map((k) => k * power).find((k) => k <= v * (1 + 1e-9)) ?? power).toPrecision(6));
}

/** To half a metre, or to a whole foot. */
export const inHalves = (m: number): number =>
  lengthUnit() === 'ft' ? fromLength(Math.round(toLength(m))) : Math.round(m * 2) / 2;

/** Step of a length field whose step in metres is given. */
export const lengthStep = (m: number): number => (lengthUnit() === 'ft' ? roundBelow(m / FOOT_M) : m);
/** Bounds of a length field: tenths of a foot within the bounds in metres. */
export const lengthRange = ([min, max]: readonly [number, number]): readonly [number, number] =>
  lengthUnit() === 'ft'
    ? [Math.ceil((min / FOOT_M) * 10 - 1e-6) / 10, Math.floor((max / FOOT_M) * 10 + 1e-6) / 10]
    : [min, max];

/** Density on lanes; the input is a number per 100 m. */
export const densityText = (per100M: number): string =>
  lengthUnit() === 'ft' ? TEXTS.per1000FtOfLane(num(per100M * 10 * FOOT_M, 1)) : TEXTS.per100MOfLane(num(per100M, 1));

export const seconds = (v: number): string => `${num(v, 1)} s`;
export const speedText = (mps: number, unit: SpeedUnit): string => num(toUnit(mps, unit), inTenths(unit) ? 1 : 0);
export const speedLabel = (mps: number, unit: SpeedUnit): string => `${speedText(mps, unit)} ${unit}`;
/** A speed in the current unit; for pedestrians in metres or feet per second. */
export const speedInUse = (mps: number, onFoot: boolean): string =>
  speedLabel(mps, onFoot ? walkingUnit(shown.value) : shown.value);

/** An angle given in radians, in whole degrees. */
export const degrees = (rad: number): string => `${num((rad * 180) / Math.PI, 0)}°`;

/** Accelerations use the unit of lengths. */
export const accelerationUnit = (): string => `${lengthUnit()}/s²`;
/** An acceleration given in m/s², with its unit. */
export const acceleration = (mps2: number, decimals = 1): string =>
  `${num(toLength(mps2), decimals)} ${accelerationUnit()}`;

/**
 * A `length` and an `acceleration` use the unit of lengths; a `place` is a coordinate of the scene and always in
 * metres.
 */
export type Quantity = 'count' | 'length' | 'acceleration' | 'place' | 'angle' | 'time' | SpeedUnit;

const UNITS: Record<string, (v: number, as: Quantity) => number | null> = {
  m: lengthTo,
  ft: (v, as) => lengthTo(v * FOOT_M, as),
  s: (v, as) => (as === 'time' ? v : null),
  '\u00b0': (v, as) => (as === 'angle' ? v : null),
  deg: (v, as) => (as === 'angle' ? v : null),
  rad: (v, as) => (as === 'angle' ? deg(v) : null),
  'km/h': (v, as) => speedTo(v / 3.6, as),
  kmh: (v, as) => speedTo(v / 3.6, as),
  kph: (v, as) => speedTo(v / 3.6, as),
  'm/s': (v, as) => speedTo(v, as),
  mph: (v, as) => speedTo(v / PER_MPS.mph, as),
  'ft/s': (v, as) => speedTo(v * FOOT_M, as),
  'm/s²': (v, as) => (as === 'acceleration' ? toLength(v) : null),
  'ft/s²': (v, as) => (as === 'acceleration' ? toLength(v * FOOT_M) : null),
};

function lengthTo(m: number, as: Quantity): number | null {
  return as === 'length' ? toLength(m) : as === 'place' ? m : null;
}

function speedTo(mps: number, as: Quantity): number | null {
  return as in PER_MPS ? mps * PER_MPS[as as SpeedUnit] : null;
}

/**
 * Reads the text of a field: `32`, `32+5`, `8.9 m/s`, `2*3`. The result is in the unit of the field; null when it
 * cannot be parsed.
 */
export function parseTyped(text: string, as: Quantity): number | null {
  const clean = text
    .trim()
    .replace(/\u2212/g, '-')
    .replace(/(?<=\d)[\u202f\u00a0](?=\d{3})/g, '')
    .replace(/s2$/, 's²')
    .replace(/,/g, '.')
    .replace(/^≈\s*/, '');
  const m = /^([-+*/().\d\s]+?)\s*([a-z°²/]*)$/i.exec(clean);
  if (!m) return null;
  const value = evaluate(m[1]);
  if (value === null) return null;
  if (!m[2]) return value;
  return UNITS[m[2].toLowerCase()]?.(value, as) ?? null;
}

/**
 * Reads a typed text as a change of the current value: `+5` adds, `-=5` subtracts, `*1.1` and `/2` scale; everything
 * else is a new value. Null when it cannot be parsed.
 */
export function readTyped(text: string, as: Quantity): ((now: number) => number) | null {
  const m = /^\s*(\+=?|-=|\u2212=|[*×/])\s*(.+)$/.exec(text);
  const v = parseTyped(m ? m[2] : text, as);
  if (v === null) return null;
  switch (m?.[1][0]) {
    case undefined:
      return () => v;
    case '+':
      return (now) => now + v;
    case '*':
    case '×':
      return (now) => now * v;
    case '/':
      return v === 0 ? null : (now) => now / v;
    default:
      return (now) => now - v;
  }
}

/** Sums and products without eval, which the page's security policy forbids. */
function evaluate(source: string): number | null {
  const tokens = source.match(/\d+\.?\d*|\.\d+|[-+*/()]/g) ?? [];
  if (tokens.join('') !== source.replace(/\s/g, '')) return null;
  let at = 0;
  const factor = (): number => {
    const t = tokens[at++];
    if (t === '-') return -factor();
    if (t === '+') return factor();
    if (t === '(') {
      const v = sum();
      at++;
      return v;
    }
    return t === undefined ? NaN : Number(t);
  };
  const product = (): number => {
    let v = factor();
    while (tokens[at] === '*' || tokens[at] === '/') v = tokens[at++] === '*' ? v * factor() : v / factor();
    return v;
  };
  const sum = (): number => {
    let v = product();
    while (tokens[at] === '+' || tokens[at] === '-') v = tokens[at++] === '+' ? v + product() : v - product();
    return v;
  };
  const v = sum();
  return at === tokens.length && Number.isFinite(v) ? v : null;
}

/** Remaining time of a long operation. */
export const leftWords = (s: number): string =>
  s > 90 ? TEXTS.aboutMinLeft(num(s / 60, 0)) : TEXTS.aboutSLeft(num(Math.ceil(s), 0));
