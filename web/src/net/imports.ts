// Files for the server to read.
import type { Box } from '../model/base/geometry';
import { Refused, type Client } from './client';
import type { ImportReply, SceneJson } from './types';

/** Companions of a file. */
export interface FileCompanions {
  /** Its network or map. */
  readonly net?: Blob;
  /** Meaning of a table's columns. */
  readonly columns?: Record<string, unknown>;
  /** The part of a map to read. */
  readonly around?: MapCircle;
}

/** In the coordinates of a file: metres, or longitude and latitude. */
export interface MapCircle {
  readonly x: number;
  readonly y: number;
  /** Metres. */
  readonly radius: number;
}

/** Least and greatest radius of a part, metres. */
export const RADIUS_M = [10, 5000] as const;

/** A circle in no map. */
const NOWHERE: MapCircle = { x: -9e7, y: -9e7, radius: RADIUS_M[0] };

const aroundOf = ({ x, y, radius }: MapCircle): string => `${x},${y},${radius}`;

/** The scenes of a file, stored. Fails as every request of the client. */
export async function importFile(
  client: Client,
  name: string,
  body: Blob,
  { net, columns, around }: FileCompanions = {},
): Promise<ImportReply> {
  const isJson = /\.json$/i.test(name);
  const form = new FormData();
  form.append('file', body, name);
  if (net) form.append('net', net);
  if (columns) form.append('columns', new Blob([JSON.stringify(columns)], { type: 'application/json' }));
  const type = isJson ? 'application/json' : 'application/octet-stream';
  const query = new URLSearchParams({ name: name.slice(-120), ...(around ? { around: aroundOf(around) } : {}) });
  const reply = await client.request(`/v1/import?${query}`, {
    method: 'POST',
    ...(net || columns ? { body: form } : { body, headers: { 'Content-Type': type } }),
  });
  return (await reply.json()) as ImportReply;
}

/** Values of the refusal of a circle that lies in no map. */
interface NothingAround {
  readonly x_range: string;
  readonly y_range: string;
}

/** The extent of a map that is too large to be read whole; null where the server does not say it. */
export async function extentOf(client: Client, name: string, body: Blob): Promise<Box | null> {
  const query = new URLSearchParams({ name: name.slice(-120), dry_run: 'true', around: aroundOf(NOWHERE) });
  try {
    const headers = { 'Content-Type': 'application/octet-stream' };
    await client.request(`/v1/import?${query}`, { method: 'POST', body, headers });
  } catch (e) {
    const message = e instanceof Refused ? e.problem.message : null;
    if (message?.code !== 'nothing-around') return null;
    const { x_range, y_range } = message.values as unknown as NothingAround;
    const [[x0, x1], [y0, y1]] = [x_range, y_range].map((range) => range.split(' to ').map(Number));
    return [x0, x1, y0, y1].every(Number.isFinite) ? { x0, x1, y0, y1 } : null;
  }
  return null;
}

/** Reads a scene like a file; nothing is stored. */
export async function tryImport(client: Client, scene: SceneJson): Promise<ImportReply> {
  const reply = await client.request('/v1/import?dry_run=true&format=dragtraffic', {
    method: 'POST',
    body: JSON.stringify(scene),
    headers: { 'Content-Type': 'application/json' },
  });
  return (await reply.json()) as ImportReply;
}
