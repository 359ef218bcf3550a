// Requests that a busy server may refuse.
import { Refused } from './client';
import { waitOf } from './problem';

/** Repeats a request while the server is busy, after the wait that each refusal asks for, until `over` is aborted. */
export async function whenFree<T>(ask: () => Promise<T>, over: AbortSignal): Promise<T> {
  for (;;) {
    try {
      return await ask();
    } catch (e) {
      const wait = e instanceof Refused ? waitOf(e.problem) : null;
      if (wait === null) throw e;
      await new Promise((later) => setTimeout(later, wait));
      over.throwIfAborted();
    }
  }
}
