// A search on the server: tries in a scene, as they come.
import type { Schemas } from '../model/base/schemas';
import type { SceneJson } from '../model/document/scene-json';
import { Refused, type Client } from './client';
import { parseLines, readLines } from './lines';
import { whenFree } from './when-free';

/** Body of a search, without its scene. */
export type SearchOptions = Omit<Schemas['SearchBody'], 'scene' | 'scene_id' | 'etag'>;

/** The scene of a search, and the same with the map inside, for a server without the map. */
export interface SearchedScene {
  readonly scene: SceneJson;
  whole(): SceneJson;
}

/** The tries of a search. It ends with `over`, and where the loop over it ends. Fails with `Refused` or `Away`. */
export async function* triesOf(
  client: Client,
  of: SearchedScene,
  options: SearchOptions,
  over: AbortSignal,
): AsyncGenerator<Schemas['SearchTry']> {
  const reply = await ask(client, of.scene, options, over).catch((e: unknown) => {
    if (!(e instanceof Refused) || !lacksMap(e)) throw e;
    return ask(client, of.whole(), options, over);
  });
  if (!reply.body) return;
  for await (const lines of readLines(reply.body))
    for (const e of parseLines<Schemas['SearchEvent']>(lines)) {
      if (e.event === 'try') yield e;
      if (e.event === 'error') throw new Refused(e.problem.status ?? 422, e.problem);
    }
}

const lacksMap = ({ problem }: Refused): boolean =>
  problem.code === 'unknown-map' || (problem.errors ?? []).some((e) => e.code === 'unknown-map');

function ask(client: Client, scene: SceneJson, options: SearchOptions, signal: AbortSignal): Promise<Response> {
  const send = () =>
    client.request('/v1/search', {
      method: 'POST',
      body: JSON.stringify({ scene, ...options }),
      headers: { 'Content-Type': 'application/json', Accept: 'application/x-ndjson' },
      signal,
    });
  return whenFree(send, signal);
}
