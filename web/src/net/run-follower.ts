// A run that somebody else steps, as it goes on.
import type { Schemas } from '../model/base/schemas';
import type { SceneJson } from '../model/document/scene-json';
import type { Client } from './client';
import { parseLines, readLines } from './lines';

export type RunEvent = Schemas['RunEvent'];

const pathOf = (run: string): string => `/v1/runs/${encodeURIComponent(run)}`;

/** The scene that a run began in. Fails with `Refused` or `Away`. */
export async function runScene(client: Client, run: string): Promise<SceneJson> {
  return (await (await client.request(`${pathOf(run)}/scene`)).json()) as SceneJson;
}

/** The run as it is now, then each step, until it is forgotten or `over`. Fails with `Refused` or `Away`. */
export async function* followRun(client: Client, run: string, over: AbortSignal): AsyncGenerator<RunEvent> {
  const reply = await client.request(pathOf(run), { headers: { Accept: 'application/x-ndjson' }, signal: over });
  if (!reply.body) return;
  for await (const lines of readLines(reply.body)) yield* parseLines<RunEvent>(lines);
}
