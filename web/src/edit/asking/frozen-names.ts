// Names of futures during a drag: an idea keeps its name until rest, unless the basis of the name is gone and another
// relation has held for a while.
import { ideas, type Future, type Futures } from '../../model/document/futures';
import { nameAll, nameRest, type FutureName, type Naming } from '../../model/words/future-names';
import { manoeuvreOf, type LaneUser } from '../../model/words/manoeuvres';

/** A new relation must hold for this long before it changes a name, in milliseconds. */
const HOLDS_MS = 400;

interface Pending {
  readonly basis: string;
  readonly since: number;
}

export class FrozenNames {
  readonly #pending = new Map<string, Pending>();

  /** The next futures with the names of those on screen, where these still hold. `now` in milliseconds. */
  keep(shown: Futures, next: Futures, who: Naming, now: number): Futures {
    const was = new Map(ideas(shown.modes).map((k, i) => [k, shown.modes[i]]));
    const fresh = nameAll(next.modes, who);
    const keys = ideas(next.modes);
    const kept = keys.map((k, i) => this.#kept(k, was.get(k), next.modes[i], fresh[i], { now, who }));
    // Names of new futures must differ from the kept names.
    const names = nameRest(
      next.modes,
      who,
      kept.map((m) => m && { name: m.name, basis: m.basis! }),
    );
    return { ...next, modes: next.modes.map((m, i) => ({ ...m, ...names[i] })) };
  }

  /** At rest all futures get new names. */
  rest(): void {
    this.#pending.clear();
  }

  /** The future on screen, if its name is kept. */
  #kept(
    key: string,
    old: Future | undefined,
    next: Future,
    fresh: FutureName,
    { now, who }: { readonly now: number; readonly who: LaneUser },
  ): Future | null {
    if (!old?.basis) return null;
    if (fresh.basis === old.basis || relationHolds(old.basis, next, who)) {
      this.#pending.delete(key);
      return old;
    }
    const known = this.#pending.get(key);
    const pending = known?.basis === fresh.basis ? known : { basis: fresh.basis, since: now };
    this.#pending.set(key, pending);
    if (now - pending.since < HOLDS_MS) return old;
    this.#pending.delete(key);
    return null;
  }
}

/** Does a future still have the relation, and the manoeuvre before it, on which a name is based? */
function relationHolds(basis: string, f: Future, who: LaneUser): boolean {
  const [manoeuvre, relation] = basis.split('|');
  const holds = f.about?.relations.some((r) => `${r.kind}:${r.with}` === relation) ?? false;
  return holds && (manoeuvre === '' || manoeuvre === manoeuvreOf(f, who));
}
