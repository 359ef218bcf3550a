// Settings for placing: size and spread for each kind, and the ghosts under the pointer.
import { batch, signal, type ReadonlySignal } from '@preact/signals-core';
import { wrapAngle, type Vec } from '../../model/base/geometry';
import type { PlacedKind } from '../../model/base/kinds';
import type { Scene } from '../../model/document/scene';
import type { Commit } from '../document/document';
import type { SessionPart } from '../session/part';
import { firstChoice, ghostAt, ghostsFor, placeWords, type Ghosts, type PlacingChoice } from './placing';

export class Placement implements SessionPart {
  readonly #choices = signal<Readonly<Partial<Record<PlacedKind, PlacingChoice>>>>({});
  readonly #ghosts = signal<Ghosts | null>(null);
  /** A heading set by the user stays for the next ones. */
  #heading: number | null = null;
  /** Requested place of the single ghost, so that keys can move it. */
  #at: Vec | null = null;
  #last: { kind: PlacedKind; zoom: number; free: boolean } | null = null;

  readonly ghosts: ReadonlySignal<Ghosts | null> = this.#ghosts;

  opened(): void {
    this.stop();
  }

  toolChosen(): void {
    this.stop();
  }

  followed({ before, after }: Commit): void {
    if (before.castKey !== after.castKey && [...after.agents.keys()].some((id) => !before.agents.has(id)))
      this.show(null);
  }

  /** How road users of a kind are placed; tracked when read in a component. */
  choice(kind: PlacedKind): PlacingChoice {
    return this.#choices.value[kind] ?? firstChoice(kind);
  }

  choose(kind: PlacedKind, patch: Partial<PlacingChoice>): void {
    this.#choices.value = { ...this.#choices.peek(), [kind]: { ...this.choice(kind), ...patch } };
  }

  get at(): Vec | null {
    return this.#at;
  }

  /** One ghost at a place. */
  pointAt(scene: Scene, kind: PlacedKind, at: Vec, zoom: number, free: boolean, heading = this.#heading): void {
    this.#at = at;
    this.#last = { kind, zoom, free };
    const who = ghostAt(scene, this.choice(kind), at, { zoom, free, heading });
    this.#ghosts.value = ghostsFor(scene, [who], placeWords(scene, who), who.lane?.id ?? null);
  }

  /** Shows the ghost again after a key. */
  again(scene: Scene, dx: number, dy: number): boolean {
    if (!this.#at || !this.#last) return false;
    const { kind, zoom, free } = this.#last;
    this.pointAt(scene, kind, [this.#at[0] + dx, this.#at[1] + dy], zoom, free);
    return true;
  }

  turnBy(scene: Scene, angle: number): boolean {
    const ghost = this.#ghosts.peek()?.all[0];
    if (!ghost) return false;
    this.#heading = wrapAngle(ghost.who.pose.heading + angle);
    return this.again(scene, 0, 0);
  }

  show(ghosts: Ghosts | null): void {
    this.#ghosts.value = ghosts;
  }

  /** Ends placing. */
  stop(): void {
    batch(() => {
      this.#ghosts.value = null;
      this.#heading = null;
      this.#at = null;
      this.#last = null;
    });
  }
}
