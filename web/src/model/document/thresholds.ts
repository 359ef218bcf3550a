// What counts as an event in a scene. Only what differs from the usual is kept.
import { patchScene, type Command } from './commands';
import { THRESHOLDS } from '../base/domain';
import { NO_THRESHOLDS, type Scene, type Thresholds } from './scene';
import { TEXTS } from '../../texts/panels/thresholds';

/** Those that the editor offers, in the order in which they are shown. */
export const OFFERED = ['gap_m', 'ttc_s', 'harsh_brake_mps2', 'harsh_lateral_mps2'] as const;
export type ThresholdName = (typeof OFFERED)[number];

export const usual = (name: ThresholdName): number => THRESHOLDS[name].usual;
export const threshold = (s: Scene, name: ThresholdName): number => s.thresholds[name] ?? usual(name);
export const isUsual = (s: Scene): boolean => !Object.keys(s.thresholds).length;

/** Numbers that can be read and are not the usual ones. */
export function readThresholds(json: unknown): Thresholds {
  const given = Object.entries(typeof json === 'object' && json ? json : {}).filter(([name, v]) => {
    const known = Object.hasOwn(THRESHOLDS, name) ? THRESHOLDS[name] : null;
    return known && typeof v === 'number' && v >= known.range[0] && v <= known.range[1] && v !== known.usual;
  });
  return given.length ? Object.freeze(Object.fromEntries(given) as Thresholds) : NO_THRESHOLDS;
}

const STEPS: Readonly<Record<ThresholdName, (value: number) => string>> = {
  gap_m: TEXTS.gapNow,
  ttc_s: TEXTS.timeNow,
  harsh_brake_mps2: TEXTS.brakingNow,
  harsh_lateral_mps2: TEXTS.steeringNow,
};

export function setThreshold(s: Scene, name: ThresholdName, value: number): Command {
  const thresholds = readThresholds({ ...s.thresholds, [name]: value });
  return patchScene(STEPS[name](value), { thresholds }, `threshold:${name}`);
}

export const resetThresholds = (): Command => patchScene(TEXTS.reset, { thresholds: NO_THRESHOLDS });
