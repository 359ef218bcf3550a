// An in-memory server for tests of the page: scenes with ETags, and for each request a fate that the test decides.
import type { SceneJson } from '../../src/model/document/scene-json';

/** The fate of a request. Times in milliseconds; the test's clock advances them. */
export interface Fate {
  /** Until the server acts on the request, and from then until its reply arrives. */
  readonly there?: number;
  readonly back?: number;
  /** `request`: the server never sees it. `reply`: the server acts, and the reply is lost. `busy`: a 503. */
  readonly fails?: 'request' | 'reply' | 'busy';
}

export interface StoredScene {
  readonly json: SceneJson;
  readonly etag: string;
}

export interface Seen {
  readonly method: string;
  readonly id: string;
  readonly status: number;
  readonly json: SceneJson | null;
  /** Its tab was closed while the request was under way. */
  readonly late: boolean;
}

export class ScriptedServer {
  readonly scenes = new Map<string, StoredScene>();
  /** Every request that the server acted on, in order. */
  readonly seen: Seen[] = [];
  /** Requests under way in either direction. */
  open = 0;
  fate: (method: string, id: string) => Fate = () => ({});
  #version = 0;

  put(id: string, json: SceneJson): string {
    const etag = `"${++this.#version}"`;
    this.scenes.set(id, { json: { ...json, id }, etag });
    return etag;
  }

  /** The fetch function of a tab; once `here` is false the tab is closed, and neither sends nor receives. */
  fetcher(here: () => boolean = () => true): typeof fetch {
    return async (url, init) => {
      if (!here()) return never();
      const method = init?.method ?? 'GET';
      const [, , collection, id = ''] = new URL(String(url), 'http://server').pathname.split('/');
      const fate = this.fate(method, id);
      this.open++;
      try {
        await passes(fate.there);
        if (fate.fails === 'request') throw new TypeError('no answer');
        const reply =
          fate.fails === 'busy'
            ? problem(503, 'shutting-down')
            : this.#act(collection, method, decodeURIComponent(id), { init, late: !here() });
        await passes(fate.back);
        if (here() && fate.fails === 'reply') throw new TypeError('no answer');
        if (here()) return reply;
      } finally {
        this.open--;
      }
      return never();
    };
  }

  #act(
    collection: string,
    method: string,
    id: string,
    { init, late }: { init?: RequestInit; late: boolean },
  ): Response {
    if (collection !== 'scenes') return problem(404, 'not-found');
    const json = typeof init?.body === 'string' ? (JSON.parse(init.body) as SceneJson) : null;
    const reply = this.#answer(method, id, json, new Headers(init?.headers));
    this.seen.push({ method, id, status: reply.status, json, late });
    return reply;
  }

  #answer(method: string, id: string, json: SceneJson | null, headers: Headers): Response {
    const scene = this.scenes.get(id);
    if (method === 'GET' && !id) {
      const scenes = [...this.scenes].map(([id, { json, etag }]) => ({ id, etag, name: json.name, readonly: false }));
      return reply(200, { scenes, next: null });
    }
    if (method === 'POST') {
      const made = `made-${this.#version + 1}`;
      return reply(201, { id: made }, this.put(made, json!));
    }
    const match = headers.get('If-Match');
    if (method === 'GET') return scene ? reply(200, scene.json, scene.etag) : problem(404, 'not-found');
    if (match === null ? scene : !scene || (match !== '*' && match !== scene.etag))
      return problem(412, 'stale-etag', scene?.etag);
    if (method === 'DELETE') this.scenes.delete(id);
    else
      return reply(scene ? 200 : 201, { id }, this.put(id, method === 'PATCH' ? { ...scene!.json, ...json } : json!));
    return reply(200, {});
  }
}

const passes = (ms?: number): Promise<void> | void =>
  ms === undefined ? undefined : new Promise((resolve) => setTimeout(resolve, ms));

const never = (): Promise<never> => new Promise(() => undefined);

/** The client reads only this much of a reply; a real one would be too slow for a thousand schedules. */
function reply(status: number, body: unknown, etag?: string): Response {
  const text = JSON.stringify(body);
  return {
    ok: status < 300,
    status,
    statusText: '',
    headers: { get: (name: string) => (name.toLowerCase() === 'etag' ? (etag ?? null) : null) },
    text: () => Promise.resolve(text),
    json: () => Promise.resolve(JSON.parse(text) as unknown),
  } as unknown as Response;
}

const problem = (status: number, code: string, etag?: string): Response =>
  reply(status, { code, title: code, status, ...(etag ? { etag } : {}) });
