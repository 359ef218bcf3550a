// Futures as the server sends them, compact, turned into those of a scene document.
import type { components } from '../model/api';
import type { AgentFuturesJson } from '../model/json';
import type { DraftEvent, FinalEvent, GenerateEvent } from './types';

type Schemas = components['schemas'];
type Sent = Schemas['FuturesDoc'];
type CompactFuture = Schemas['CompactFuture'];

/** An event with its futures in columns; the same numbers to the last digit. */
export function expanded(e: Schemas['Event']): GenerateEvent {
  if (e.event === 'initial' || e.event === 'step') return { ...e, agents: all(e.agents) } as DraftEvent;
  if (e.event !== 'final') return e as GenerateEvent;
  return { ...e, samples: e.samples.map((s) => ({ ...s, agents: all(s.agents) })) } as FinalEvent;
}

const all = (agents: Record<string, Sent>): Record<string, AgentFuturesJson> =>
  Object.fromEntries(Object.entries(agents).map(([id, sent]) => [id, futures(sent)]));

function futures(sent: Sent): AgentFuturesJson {
  if (!('compact' in sent)) return sent as AgentFuturesJson;
  const { compact, ...rest } = sent;
  return { ...rest, modes: compact.map(columns) } as AgentFuturesJson;
}

function columns({ x_mm, y_mm, heading_e4rad, vx_mmps, vy_mmps, ...rest }: CompactFuture) {
  return {
    ...rest,
    x_m: summed(x_mm, 1e3),
    y_m: summed(y_mm, 1e3),
    heading_rad: summed(heading_e4rad, 1e4),
    vx_mps: summed(vx_mmps, 1e3),
    vy_mps: summed(vy_mmps, 1e3),
  };
}

/** The first number is a value, the second a change, each further one a change of the change. */
function summed(numbers: ArrayLike<number>, perUnit: number): number[] {
  const out = new Array<number>(numbers.length);
  for (let i = 0, value = 0, change = 0; i < numbers.length; i++) {
    if (i) value += change += numbers[i];
    else value = numbers[0];
    out[i] = value / perUnit;
  }
  return out;
}
