// Data of each variant, and of two compared ones.
import { counted, worstOf } from '../../../model/physics/events';
import { readEvents, type TrafficEvent } from '../../../model/words/event-words';
import type { MotionSet } from '../../../model/document/futures';
import { comparisonOf, type Comparison, type ComparedVariant } from '../../../model/words/comparison';
import { sceneKey, type Agent, type Scene, type Variant, type VariantState } from '../../../model/document/scene';
import { nameVariants } from '../../../model/words/variant-names';
import type { SpeedUnit } from '../../../model/base/units';
import { sameCast, sceneOfVariant } from '../../../model/document/variants';

/** A variant with its known data. */
export interface Card {
  readonly id: number;
  readonly variant: Variant;
  readonly state: VariantState;
  /** Its document; null where the scene has other road users now. */
  readonly scene: Scene | null;
  /** Null until it is computed. */
  readonly set: MotionSet | null;
  readonly events: readonly TrafficEvent[];
  readonly name: string;
}

/** Content of a picture: all road users of a document, and the path of one. */
export type Pictured = Pick<Card, 'scene' | 'set' | 'events'> & { readonly state: { readonly subject: string | null } };

/** A card with all its data. */
export type WholeCard = Card & { readonly scene: Scene; readonly set: MotionSet };

export interface Compared {
  readonly left: WholeCard;
  readonly right: WholeCard;
  readonly comparison: Comparison;
}

export type VariantFilter = 'all' | 'events' | 'starred';

export const isWhole = (c: Card | undefined): c is WholeCard => !!c?.scene && !!c.set;

export function cardsOf(
  scene: Scene,
  list: readonly Variant[],
  states: Scene['variantStates'],
  sets: ReadonlyMap<string, MotionSet>,
  unitOf: (a: Agent) => SpeedUnit,
): Card[] {
  const cards = list.map((variant) => {
    const state = states[variant.id];
    const own = sameCast(scene, state) ? sceneOfVariant(scene, state) : null;
    const set = (own && sets.get(sceneKey(own))) ?? null;
    return { id: variant.id, variant, state, scene: own, set, events: own && set ? readEvents(own, set) : [] };
  });
  const names = nameVariants(cards, unitOf);
  const all = cards.map((c, i): Card => ({ ...c, name: c.variant.called ?? names[i] }));
  // Starred ones come first.
  return [...all.filter((c) => c.variant.starred), ...all.filter((c) => !c.variant.starred)];
}

export function comparedOf(cards: readonly Card[], pair: readonly [number, number] | null): Compared | null {
  const [left, right] = (pair ?? []).map((id) => cards.find((c) => c.id === id));
  if (!isWhole(left) || !isWhole(right)) return null;
  const side = (c: WholeCard): ComparedVariant => ({
    label: String(c.id),
    scene: c.scene,
    set: c.set,
    events: c.events,
  });
  return { left, right, comparison: comparisonOf(side(left), side(right)) };
}

export const hasEvents = (c: Pick<Card, 'events'>): boolean => worstOf(counted(c.events)) !== null;

export function filtered(cards: readonly Card[], filter: VariantFilter): readonly Card[] {
  if (filter === 'events') return cards.filter(hasEvents);
  return filter === 'starred' ? cards.filter((c) => c.variant.starred) : cards;
}
