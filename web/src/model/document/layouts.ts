// Map templates in display order, and the ranges of their parameters.
import domain from '../../../../assets/domain.json';
import type { Schemas } from '../base/schemas';
import { TEXTS } from '../../texts/panels/layouts';

export type TemplateName = Schemas['Template'];

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

/** Range of a template's parameter, by its path, such as `arms.length_m`. */
export function rangeOf(template: TemplateName, place: string): readonly [number, number] {
  const ranges: Readonly<Record<string, readonly number[]>> = domain.layout_ranges[KIND[template]];
  const [least, most] = ranges[place] ?? [-Infinity, Infinity];
  return [least, most];
}

export type LaneConnection = Schemas['Connection'];

export interface Connections {
  readonly added: readonly LaneConnection[];
  readonly removed: readonly LaneConnection[];
}

/** A lane of an arm, both counted from 0; lanes from the middle of the road to the kerb. */
export type LaneOfArm = readonly [arm: number, lane: number];

export const NO_CONNECTIONS: Connections = { added: [], removed: [] };

export function connectionOf(from: LaneOfArm, to: LaneOfArm): LaneConnection {
  return { from: `arm${from[0] + 1}.in${from[1] + 1}`, to: `arm${to[0] + 1}.out${to[1] + 1}` };
}

export function laneOf(id: string): LaneOfArm {
  const [, arm = '1', lane = '1'] = /^arm(\d+)\.(?:in|out)(\d+)$/.exec(id) ?? [];
  return [Number(arm) - 1, Number(lane) - 1];
}

export const sameWay = (a: LaneConnection, b: LaneConnection): boolean => a.from === b.from && a.to === b.to;

/** Connections that still have lanes; `gone` is the index of a removed arm. */
export function fitting(
  { added, removed }: Connections,
  arms: readonly { lanes_in: number; lanes_out: number }[],
  gone: number | null = null,
): Connections {
  const moved = ([arm, lane]: LaneOfArm): LaneOfArm => [gone !== null && arm > gone ? arm - 1 : arm, lane];
  const kept = (list: readonly LaneConnection[]): readonly LaneConnection[] =>
    list.flatMap((c) => {
      const [from, to] = [laneOf(c.from), laneOf(c.to)];
      if (from[0] === gone || to[0] === gone) return [];
      const [a, b] = [moved(from), moved(to)];
      const there = a[1] < (arms[a[0]]?.lanes_in ?? 0) && b[1] < (arms[b[0]]?.lanes_out ?? 0);
      return there ? [connectionOf(a, b)] : [];
    });
  return { added: kept(added), removed: kept(removed) };
}
