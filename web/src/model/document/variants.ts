// Variants: alternatives of the scene, side by side. A variant is conditions and the generator's seed; its motion is
// computed from these and not part of the document.
import { inOneStep, patchAgents, patchScene, recorded, type AgentPatch, type Command } from './commands';
import {
  type AgentConditions,
  type Variant,
  type VariantState,
  durationOf,
  sceneKey,
  touched,
  type Agent,
  type Scene,
} from './scene';
import { TEXTS } from '../../texts/editing/variants';

/** Maximum number made at once, and in a scene, kept ones included. */
export const MOST_NEW = 10;
export const MOST_VARIANTS = 30;

/** The current document, as a variant. */
export function stateOfVariant(scene: Scene, subject: string | null): VariantState {
  const { seed, diversity, others, length, replan, drawn, castKey } = scene;
  const asked = [...scene.agents.values()].filter((a) => touched(a) || a.does !== null);
  return Object.freeze({
    seed,
    diversity,
    others,
    length,
    replan,
    drawn,
    subject,
    castKey,
    asked: Object.freeze(Object.fromEntries(asked.map((a) => [a.id, askedOf(a)]))),
  });
}

export const askedOf = ({
  start,
  goal,
  chosen,
  dealt,
  profile,
  length,
  width,
  type,
  kind,
  subtype,
  does,
}: Agent): AgentConditions =>
  Object.freeze({ start, goal, chosen, dealt, profile, length, width, type, kind, subtype, does });

/** Has the scene the road users of the variant? */
export const sameCast = (scene: Scene, state: VariantState): boolean => state.castKey === scene.castKey;

const NOTHING = { does: null } as const;

/** Makes the document equal to a variant. */
export function takeVariant(scene: Scene, state: VariantState, name: string): Command {
  const { seed, diversity, others, length, replan, drawn } = state;
  const patches = new Map<string, AgentPatch>();
  for (const a of scene.agents.values()) {
    const asked = state.asked[a.id];
    if (asked) patches.set(a.id, asked);
    else if (touched(a) || a.does !== null)
      patches.set(a.id, { ...recorded(a), chosen: null, profile: null, ...NOTHING });
  }
  const duration = durationOf(length, scene.steps);
  return {
    ...inOneStep(
      patchScene(name, { seed, diversity, others, length, replan, drawn, duration }),
      patchAgents(name, patches),
    ),
    fold: 'variant',
  };
}

export const sceneOfVariant = (scene: Scene, state: VariantState): Scene => takeVariant(scene, state, '').apply(scene);

/** Document key of a variant. */
export const keyOfVariant = (scene: Scene, state: VariantState): string => sceneKey(sceneOfVariant(scene, state));

// -------------------------------------------------------------- commands

type States = Scene['variantStates'];

const put = (name: string, variants: readonly Variant[], variantStates: States): Command =>
  patchScene(name, { variants: Object.freeze(variants), variantStates: Object.freeze(variantStates) });

/** New ones replace all that are neither kept nor starred. */
export function replaceVariants(scene: Scene, fresh: readonly VariantState[]): Command {
  const stay = scene.variants.filter((v) => v.kept || v.starred);
  const first = nextVariant(scene);
  const come = fresh
    .slice(0, MOST_VARIANTS - stay.length)
    .map((_, i): Variant => ({ id: first + i, called: null, kept: false, starred: false }));
  const states: Record<number, VariantState> = {};
  for (const v of stay) states[v.id] = scene.variantStates[v.id];
  come.forEach((v, i) => (states[v.id] = fresh[i]));
  const n = come.length;
  return put(TEXTS.oneVariantMade(n), [...stay, ...come], states);
}

/** Id of the next one: larger than any before. */
const nextVariant = (scene: Scene): number => 1 + Math.max(0, ...scene.variants.map((v) => v.id));

export type VariantPatch = Partial<Omit<Variant, 'id'>>;

export const patchVariant = (scene: Scene, id: number, patch: VariantPatch, name: string): Command =>
  patchScene(name, {
    variants: Object.freeze(scene.variants.map((v) => (v.id === id ? Object.freeze({ ...v, ...patch }) : v))),
  });

/** Adds the current document to the variants, kept. */
export const keepAsVariant = (scene: Scene, name: string): Command | null =>
  keepStates(scene, [stateOfVariant(scene, null)], name);

/** Adds others, kept; null where there is no room for all. */
export function keepStates(
  scene: Scene,
  fresh: readonly VariantState[],
  name: string,
  starred: readonly boolean[] = [],
): Command | null {
  if (scene.variants.length + fresh.length > MOST_VARIANTS) return null;
  const first = nextVariant(scene);
  const come = fresh.map((_, i): Variant => ({
    id: first + i,
    called: null,
    kept: true,
    starred: starred[i] ?? false,
  }));
  const states = Object.fromEntries(fresh.map((state, i) => [first + i, state]));
  return put(name, [...scene.variants, ...come], { ...scene.variantStates, ...states });
}

export function removeVariant(scene: Scene, id: number, name: string): Command {
  const states = Object.fromEntries(Object.entries(scene.variantStates).filter(([k]) => Number(k) !== id));
  return put(
    name,
    scene.variants.filter((v) => v.id !== id),
    states,
  );
}
