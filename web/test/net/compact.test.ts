// Compact futures are expanded to the columns that the server would have sent.
import { expect, test } from 'vitest';
import { expanded } from '../../src/net/compact';

const head = { seq: 1, job: 'j', elapsed_ms: 1 };

test('a compact column is a value, a difference, and differences of differences', () => {
  const future = {
    probability: 0.5,
    first_step: 1,
    x_mm: [-1500, 1200, 3, -4],
    y_mm: [0, 0, 1, 0],
    heading_e4rad: [31415, -62829, 62832, 1],
    vx_mmps: [12346, 0, 0, 0],
    vy_mmps: [-1, -1, -1, -1],
  };
  const sent = {
    ...head,
    event: 'initial',
    window: 0,
    sample: 0,
    steps: 5,
    agents: { a: { chosen: 0, compact: [future] } },
  };
  const e = expanded(sent as Parameters<typeof expanded>[0]);
  if (e.event !== 'initial') throw new Error(e.event);
  const { modes, ...rest } = e.agents.a;
  const listed = modes.map((m) =>
    Object.fromEntries(Object.entries(m).map(([k, v]) => [k, v instanceof Float64Array ? [...v] : v])),
  );
  expect({ ...rest, modes: listed }).toEqual({
    chosen: 0,
    modes: [
      {
        probability: 0.5,
        first_step: 1,
        x_m: [-1.5, -0.3, 0.903, 2.102],
        y_m: [0, 0, 0.001, 0.002],
        heading_rad: [3.1415, -3.1414, -3.1411, -3.1407],
        vx_mps: [12.346, 12.346, 12.346, 12.346],
        vy_mps: [-0.001, -0.002, -0.004, -0.007],
      },
    ],
  });
});

test('futures sent in columns stay unchanged', () => {
  const agents = { a: { chosen: 0, modes: [{ probability: 1, first_step: 1, x_m: [1], y_m: [2] }] } };
  const final = { ...head, event: 'final', samples: [{ agents, score: null }], windows: 1 };
  const e = expanded(final as unknown as Parameters<typeof expanded>[0]);
  expect(e).toEqual(final);
});
