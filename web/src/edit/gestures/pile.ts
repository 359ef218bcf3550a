// Overlapping boxes: a second click soon after the first takes the next one below.

const AGAIN_WITHIN_MS = 800;

export class Pile {
  #last: { ids: string[]; index: number; timeStamp: number } | null = null;

  /** The road user that a click takes. */
  take(ids: string[], timeStamp: number): string {
    const last = this.#last;
    const again = last && last.ids.join() === ids.join() && timeStamp - last.timeStamp < AGAIN_WITHIN_MS;
    const index = again ? (last.index + 1) % ids.length : 0;
    this.#last = { ids, index, timeStamp };
    return ids[index];
  }
}
