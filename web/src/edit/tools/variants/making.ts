// The making of variants: progress, seeds, and which of them stands for the shown future.
import { counted, worstOf } from '../../../model/physics/events';
import { readEvents } from '../../../model/words/event-words';
import { ideas, type MotionSet } from '../../../model/document/futures';
import type { Scene } from '../../../model/document/scene';
import { Away, Refused } from '../../../net/client';
import { Stopped, type Take } from '../../asking/take-maker';
import type { Pictured } from './cards';
import { TEXTS } from '../../../texts/editing/variants';

/** Progress of the making, and the events so far. */
export interface Making {
  /** Variants made so far. */
  readonly made: readonly Pictured[];
  readonly of: number;
  /** Number without events, with a near miss or a rule violation, and with a collision. */
  readonly clear: number;
  readonly near: number;
  readonly hit: number;
  /** Estimated seconds left, from the first ones; null at the start. */
  readonly left: number | null;
}

export const begun = (of: number): Making => ({ made: [], of, clear: 0, near: 0, hit: 0, left: null });

export function withOne(m: Making, { scene, set }: Take, subject: string | null, tookS: number): Making {
  const events = readEvents(scene, set);
  const worst = worstOf(counted(events));
  const made = [...m.made, { scene, set, events, state: { subject } }];
  return {
    ...m,
    made,
    clear: m.clear + Number(worst === null),
    hit: m.hit + Number(worst === 'collision'),
    near: m.near + Number(worst !== null && worst !== 'collision'),
    left: (tookS / made.length) * (m.of - made.length),
  };
}

/** The take that picks the shown future of the subject; -1 for none. */
export function likeShown(now: MotionSet, takes: readonly Take[], subject: string): number {
  const picked = (set: MotionSet, index: number | null): string | undefined => {
    const f = set.futures.get(subject);
    return f && ideas(f.modes)[index ?? f.chosen];
  };
  const shown = picked(now, null);
  return takes.findIndex((t) => picked(t.set, t.scene.agents.get(subject)?.chosen ?? null) === shown);
}

/** Clears the pick of the subject: the variants pick for it. */
export function withoutPick(scene: Scene, subject: string | null): Scene {
  const a = subject === null ? undefined : scene.agents.get(subject);
  if (!a || a.chosen === null) return scene;
  const agents = new Map(scene.agents).set(a.id, Object.freeze({ ...a, chosen: null }));
  return Object.freeze({ ...scene, agents });
}

/**
 * The seed of the first new variant. New ones continue after the seeds of present ones. With one subject the same
 * futures answer the same request, so the document's own seed is used.
 */
export function nextSeed(scene: Scene, subject: string | null): number {
  const used = scene.variants.map((v) => scene.variantStates[v.id]).filter((s) => s.subject === subject);
  if (!used.some((s) => s.seed === scene.seed)) return scene.seed;
  return (Math.max(...used.map((s) => s.seed)) + 1) % Number.MAX_SAFE_INTEGER;
}

export function reasonOf(e: unknown): string | null {
  if (e instanceof Stopped) return null;
  if (e instanceof Refused) return e.message;
  if (e instanceof Away) return TEXTS.theGeneratorIs;
  throw e;
}
