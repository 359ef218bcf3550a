// Files for the server to read.
import type { Client } from './client';
import type { ImportReply, SceneJson } from './types';

/** Companions of a file. */
export interface FileCompanions {
  /** Its network or map. */
  readonly net?: Blob;
  /** Meaning of a table's columns. */
  readonly columns?: Record<string, unknown>;
}

/** The scenes of a file, stored. Fails as every request of the client. */
export async function importFile(
  client: Client,
  name: string,
  body: Blob,
  { net, columns }: FileCompanions = {},
): Promise<ImportReply> {
  const isJson = /\.json$/i.test(name);
  const form = new FormData();
  form.append('file', body, name);
  if (net) form.append('net', net);
  if (columns) form.append('columns', new Blob([JSON.stringify(columns)], { type: 'application/json' }));
  const type = isJson ? 'application/json' : 'application/octet-stream';
  const reply = await client.request(`/v1/import?name=${encodeURIComponent(name.slice(-120))}`, {
    method: 'POST',
    ...(net || columns ? { body: form } : { body, headers: { 'Content-Type': type } }),
  });
  return (await reply.json()) as ImportReply;
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
