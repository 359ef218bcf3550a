// Converts the server's compact futures to those of a scene document.
import type { Schemas } from '../model/base/schemas';
import type { AgentFuturesJson } from '../model/document/scene-json';
import type { DraftEvent, FinalEvent, GenerateEvent } from './types';

type SentFutures = Schemas['Futures'];
type CompactFuture = Schemas['CompactFuture'];

/** An event with its futures in columns; numbers are equal to the last digit, all in one memory block. */
export function expanded(e: Schemas['Event']): GenerateEvent {
  const all = (agents: Record<string, SentFutures>, to: Block): Record<string, AgentFuturesJson> =>
    Object.fromEntries(Object.entries(agents).map(([id, sent]) => [id, futures(sent, to)]));
  if (e.event === 'initial' || e.event === 'step')
    return { ...e, agents: all(e.agents, new Block([e.agents])) } as DraftEvent;
  if (e.event !== 'final') return e as GenerateEvent;
  const to = new Block(e.samples.map((s) => s.agents));
  return { ...e, samples: e.samples.map((s) => ({ ...s, agents: all(s.agents, to) })) } as FinalEvent;
}

/** Memory for all columns of an event: one block passes between threads faster than a hundred small ones. */
class Block {
  readonly #numbers: Float64Array;
  #used = 0;

  constructor(samples: readonly Record<string, SentFutures>[]) {
    let count = 0;
    for (const sent of samples.flatMap((agents) => Object.values(agents)))
      if ('compact' in sent)
        for (const c of sent.compact)
          count += c.x_mm.length + c.y_mm.length + c.heading_e4rad.length + c.vx_mmps.length + c.vy_mmps.length;
    this.#numbers = new Float64Array(count);
  }

  /** The first number is a value, the second a difference, each further one a difference of differences. */
  summed(numbers: ArrayLike<number>, perUnit: number): Float64Array {
    const out = this.#numbers.subarray(this.#used, (this.#used += numbers.length));
    for (let i = 0, value = 0, change = 0; i < numbers.length; i++) {
      if (i) value += change += numbers[i];
      else value = numbers[0];
      out[i] = value / perUnit;
    }
    return out;
  }
}

function futures(sent: SentFutures, to: Block): AgentFuturesJson {
  if (!('compact' in sent)) return sent as AgentFuturesJson;
  const { compact, ...rest } = sent;
  return { ...rest, modes: compact.map((c) => columns(c, to)) } as unknown as AgentFuturesJson;
}

function columns({ x_mm, y_mm, heading_e4rad, vx_mmps, vy_mmps, ...rest }: CompactFuture, to: Block) {
  return {
    ...rest,
    x_m: to.summed(x_mm, 1e3),
    y_m: to.summed(y_mm, 1e3),
    heading_rad: to.summed(heading_e4rad, 1e4),
    vx_mps: to.summed(vx_mmps, 1e3),
    vy_mps: to.summed(vy_mmps, 1e3),
  };
}
