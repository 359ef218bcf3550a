// Guessed meanings of foreign tables' columns, and their form for the server.
import { expect, it } from 'vitest';
import { complete, guessed, toldColumns } from '../../src/edit/tools/outward/table-columns';

const named = (columns: string[]) =>
  Object.fromEntries(
    Object.entries(guessed(columns)).flatMap(([field, { column }]) => (column ? [[field, column]] : [])),
  );

it('guesses by common names, each column once', () => {
  expect(named(['frame', 'trackId', 'xCenter', 'yCenter', 'heading', 'width', 'length', 'class', 'lane'])).toEqual({
    agent_id: 'trackId',
    time_s: 'frame',
    x_m: 'xCenter',
    y_m: 'yCenter',
    heading_rad: 'heading',
    type: 'class',
    length_m: 'length',
    width_m: 'width',
  });
  expect(named(['Vehicle_ID', 'Global_Time', 'Local_X', 'Local_Y', 'v_Vel', 'v_length', 'v_Width'])).toEqual({
    agent_id: 'Vehicle_ID',
    time_s: 'Global_Time',
    x_m: 'Local_X',
    y_m: 'Local_Y',
    speed_mps: 'v_Vel',
    length_m: 'v_length',
    width_m: 'v_Width',
  });
  expect(named(['track_id', 'timestamp_ms', 'x', 'y', 'psi_rad', 'agent_type'])).toMatchObject({
    time_s: 'timestamp_ms',
  });
});

it('reads units from the ends of names', () => {
  const told = toldColumns(guessed(['track_id', 'timestamp_ms', 'x', 'y', 'psi_rad']));
  expect(told).toEqual({
    agent_id: { column: 'track_id' },
    time_s: { column: 'timestamp_ms', unit: 'ms' },
    x_m: { column: 'x' },
    y_m: { column: 'y' },
    heading_rad: { column: 'psi_rad' },
  });
  expect(toldColumns(guessed(['id', 'frame', 'x', 'y', 'heading']))).toMatchObject({
    time_s: { column: 'frame', factor: 1 / 25 },
    heading_rad: { column: 'heading', unit: 'deg' },
  });
});

it('sends steps under their own name, and omits unassigned columns', () => {
  const answers = guessed(['id', 'frame', 'x', 'y']);
  const steps = { ...answers, time_s: { column: 'frame', unit: 4 } };
  expect(Object.keys(toldColumns(steps)).sort()).toEqual(['agent_id', 'step', 'x_m', 'y_m']);
});

it('is complete once id, time and position are assigned', () => {
  const answers = guessed(['id', 'frame', 'x', 'north']);
  expect(complete(answers)).toBe(false);
  expect(complete({ ...answers, y_m: { column: 'north', unit: 0 } })).toBe(true);
});
