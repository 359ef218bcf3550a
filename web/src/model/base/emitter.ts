// How a lower layer notifies the layers above it of an event. A state that can be read at any time is a signal instead.

/** An event with the arguments `A`. */
export class Emitter<A extends unknown[] = []> {
  readonly #listeners = new Set<(...args: A) => void>();

  /** Calls `hear` at each event, after the listeners before it, until the returned function is called. */
  listen(hear: (...args: A) => void): () => void {
    const listener = (...args: A): void => hear(...args);
    this.#listeners.add(listener);
    return () => void this.#listeners.delete(listener);
  }

  /** A listener added meanwhile hears the next event first, and one removed meanwhile does not hear this one. */
  emit(...args: A): void {
    for (const hear of [...this.#listeners]) if (this.#listeners.has(hear)) hear(...args);
  }
}
