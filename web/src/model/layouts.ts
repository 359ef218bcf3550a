// Templates of maps in the order in which they are offered, and the ranges of their parameters.
import domain from '../../../assets/domain.json';
import type { components } from './api';
import { TEXTS } from '../texts/layouts';

export type TemplateName = components['schemas']['Template'];

export const TEMPLATE_TITLES: Readonly<Record<TemplateName, string>> = {
  'three-arms': TEXTS.threeArms,
  'four-arms': TEXTS.fourArms,
  roundabout: TEXTS.roundabout,
  merge: TEXTS.merge,
  straight: TEXTS.straight,
  curve: TEXTS.curve,
  'school-street': TEXTS.schoolStreet,
  'car-park': TEXTS.carPark,
};

export const TEMPLATES = Object.keys(TEMPLATE_TITLES) as readonly TemplateName[];

const KIND: Readonly<Record<TemplateName, keyof typeof domain.layout_ranges>> = {
  'three-arms': 'junction',
  'four-arms': 'junction',
  roundabout: 'roundabout',
  merge: 'merge',
  straight: 'road',
  curve: 'road',
  'school-street': 'road',
  'car-park': 'car_park',
};

/** Least and greatest value of a parameter of a template, by its place, such as `arms.length_m`. */
export function rangeOf(template: TemplateName, place: string): readonly [number, number] {
  const ranges: Readonly<Record<string, readonly number[]>> = domain.layout_ranges[KIND[template]];
  const [least, most] = ranges[place] ?? [-Infinity, Infinity];
  return [least, most];
}
