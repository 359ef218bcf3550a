// Numbers as people read and type them. Inside the program everything is SI.
import { TEXTS } from '../texts/places';
import { deg } from './geometry';

export type SpeedUnit = 'km/h' | 'm/s' | 'mph';

/** Those that one may see speeds of vehicles in; people on foot are always told in m/s. */
const SPEED_UNITS: readonly SpeedUnit[] = ['km/h', 'mph', 'm/s'];
export const nextSpeedUnit = (unit: SpeedUnit): SpeedUnit =>
  SPEED_UNITS[(SPEED_UNITS.indexOf(unit) + 1) % SPEED_UNITS.length];

const PER_MPS: Record<SpeedUnit, number> = { 'km/h': 3.6, 'm/s': 1, mph: 2.2369362920544 };

export const toUnit = (mps: number, unit: SpeedUnit): number => mps * PER_MPS[unit];
export const fromUnit = (value: number, unit: SpeedUnit): number => value / PER_MPS[unit];

/** Fixed decimals with a true minus sign and no negative zero. */
export function num(value: number, decimals = 1): string {
  const text = Math.abs(value).toFixed(decimals);
  return value < 0 && Number(text) !== 0 ? `\u2212${text}` : text;
}

export const metres = (v: number, decimals = v < 10 ? 1 : 0): string => `${num(v, decimals)} m`;
/** The length or width of a road user: what is smaller than a metre has its centimetres. */
export const sizeText = (v: number): string => num(v, v < 1 && Math.abs(v * 10 - Math.round(v * 10)) > 1e-6 ? 2 : 1);
export const seconds = (v: number): string => `${num(v, 1)} s`;
export const speedText = (mps: number, unit: SpeedUnit): string => num(toUnit(mps, unit), unit === 'm/s' ? 1 : 0);
export const speedLabel = (mps: number, unit: SpeedUnit): string => `${speedText(mps, unit)} ${unit}`;

export type Quantity = 'count' | 'length' | 'angle' | 'time' | SpeedUnit;

const UNITS: Record<string, (v: number, as: Quantity) => number | null> = {
  m: (v, as) => (as === 'length' ? v : null),
  ft: (v, as) => (as === 'length' ? v * 0.3048 : null),
  s: (v, as) => (as === 'time' ? v : null),
  '\u00b0': (v, as) => (as === 'angle' ? v : null),
  deg: (v, as) => (as === 'angle' ? v : null),
  rad: (v, as) => (as === 'angle' ? deg(v) : null),
  'km/h': (v, as) => speedTo(v / 3.6, as),
  kmh: (v, as) => speedTo(v / 3.6, as),
  kph: (v, as) => speedTo(v / 3.6, as),
  'm/s': (v, as) => speedTo(v, as),
  mph: (v, as) => speedTo(v / PER_MPS.mph, as),
};

function speedTo(mps: number, as: Quantity): number | null {
  return as in PER_MPS ? mps * PER_MPS[as as SpeedUnit] : null;
}

/**
 * Reads what was typed into a field: `32`, `32+5`, `8.9 m/s`, `2*3`. The answer is in the unit the field
 * shows; null when it cannot be understood.
 */
export function parseTyped(text: string, as: Quantity): number | null {
  const clean = text
    .trim()
    .replace(/\u2212/g, '-')
    .replace(/,/g, '.')
    .replace(/^≈\s*/, '');
  const m = /^([-+*/().\d\s]+?)\s*([a-z°/]*)$/i.exec(clean);
  if (!m) return null;
  const value = evaluate(m[1]);
  if (value === null) return null;
  if (!m[2]) return value;
  return UNITS[m[2].toLowerCase()]?.(value, as) ?? null;
}

/**
 * What was typed as a change of what is there: `+5` adds, `-=5` takes away, `*1.1` and `/2` scale; everything else is
 * a value of its own. Null when it cannot be understood.
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

/** Sums and products without eval: the page's security policy forbids it, and rightly so. */
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

/** What is left of something that takes a while. */
export const leftWords = (s: number): string =>
  s > 90 ? TEXTS.aboutMinLeft(num(s / 60, 0)) : TEXTS.aboutSLeft(num(Math.ceil(s), 0));
