// Colours come from the style sheet, so that canvas and panels agree. Read once per theme change.

const NAMES = [
  'surface',
  'surface-2',
  'surface-3',
  'line',
  'line-strong',
  'ink',
  'ink-2',
  'ink-3',
  'select',
  'halo',
  'focus',
  'vehicle',
  'vehicle-glass',
  'cyclist',
  'cyclist-glass',
  'pedestrian',
  'pedestrian-glass',
  'parked',
  'parked-glass',
  'log',
  'mode-a',
  'mode-b',
  'mode-c',
  'mode-d',
  'mode-e',
  'mode-f',
  'mode-a-on',
  'mode-b-on',
  'mode-c-on',
  'mode-d-on',
  'mode-e-on',
  'mode-f-on',
  'goal',
  'goal-text',
  'goal-soft',
  'collision',
  'collision-soft',
  'on-collision',
  'near',
  'near-edge',
  'near-text',
  'near-soft',
  'on-near',
  'ok',
  'busy',
  'map-ground',
  'map-sidewalk',
  'map-asphalt',
  'map-lot',
  'map-line',
  'map-yellow',
  'map-crosswalk',
  'map-kerb',
  'map-bike',
  'map-stop',
  'map-grid',
  'map-paved',
] as const;

export type ColourName = (typeof NAMES)[number];
export type Palette = Record<ColourName, string>;

let palette = {} as Palette;
let stamp = 0;

export function readPalette(): Palette {
  const style = getComputedStyle(document.documentElement);
  const next = {} as Palette;
  for (const n of NAMES) next[n] = style.getPropertyValue(`--${n}`).trim() || '#888';
  palette = next;
  stamp++;
  return palette;
}

export const colours = (): Palette => palette;
/** Changes with every theme; part of every sprite's key. */
export const paletteStamp = (): number => stamp;

export const modeColour = (i: number): string => palette[`mode-${'abcdef'[Math.min(5, i)]}` as ColourName];
export const modeOnColour = (i: number): string => palette[`mode-${'abcdef'[Math.min(5, i)]}-on` as ColourName];

export const font = (weight: number, px: number): string => `${weight} ${px}px "Inter Variable", system-ui, sans-serif`;
