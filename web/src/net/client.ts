// Plain requests to the server. Every failure is one of two: a refusal (`Refused`), or no answer (`Away`).
import { problemOf } from './problem';
import { ROOT } from './root';
import { inWords } from './refusal';
import type {
  MapReply,
  Parameters,
  PlaceReply,
  Problem,
  SceneJson,
  SceneListReply,
  SceneItemChange,
  ScoreReply,
  TemplateName,
  FormatInfo,
} from './types';
import type { MapJson } from '../model/document/scene-json';

export class Away extends Error {}

export class Refused extends Error {
  constructor(
    readonly status: number,
    readonly problem: Problem,
  ) {
    super(inWords(problem, problem.detail ?? problem.title));
  }
}

/** The version of a scene, whatever the encoding: compressed replies add a suffix. */
const etagOf = (reply: Response): string | null => reply.headers.get('etag')?.replace(/-gzip"$/, '"') ?? null;

/** Gateway errors and "shutting down" mean the generator is unreachable; "busy" is an answer, and temporary. */
const isAway = (status: number): boolean => status === 502 || status === 503 || status === 504;

export class Client {
  constructor(
    private readonly base = ROOT,
    private readonly fetcher: typeof fetch = (...a) => fetch(...a),
  ) {}

  /** The plain reply, whatever its status; `request` turns refusals into errors. */
  send(path: string, init?: RequestInit): Promise<Response> {
    return this.fetcher(this.base + path, init);
  }

  async request(path: string, init?: RequestInit): Promise<Response> {
    let reply: Response;
    try {
      reply = await this.send(path, init);
    } catch (e) {
      if ((e as Error).name === 'AbortError') throw e;
      throw new Away('The server did not answer.');
    }
    if (reply.ok || reply.status === 304) return reply;
    const problem = await problemOf(reply);
    if (isAway(reply.status) && problem.code !== 'busy') throw new Away(problem.detail ?? problem.title);
    throw new Refused(reply.status, problem);
  }

  async scenes(query = ''): Promise<SceneListReply> {
    const all: SceneListReply = { scenes: [], next: null };
    let after: string | null = null;
    do {
      const p = new URLSearchParams({ limit: '200', ...(query ? { q: query } : {}), ...(after ? { after } : {}) });
      const page = (await (await this.request(`/v1/scenes?${p}`)).json()) as SceneListReply;
      all.scenes.push(...page.scenes);
      after = page.next;
    } while (after && all.scenes.length < 2000);
    return all;
  }

  async scene(id: string): Promise<{ json: SceneJson; etag: string | null }> {
    const reply = await this.request(`/v1/scenes/${encodeURIComponent(id)}`);
    return { json: (await reply.json()) as SceneJson, etag: etagOf(reply) };
  }

  /** Content of a scene's thumbnail; the browser caches it until the scene changes. */
  async preview(id: string): Promise<SceneJson> {
    return (await (await this.request(`/v1/scenes/${encodeURIComponent(id)}/preview`)).json()) as SceneJson;
  }

  async map(ref: string): Promise<MapJson> {
    return (await (await this.request(`/v1/maps/${ref.replace(/^sha256:/, '')}`)).json()) as MapJson;
  }

  async save(id: string, body: SceneJson, etag: string | null): Promise<string | null> {
    const reply = await this.request(`/v1/scenes/${encodeURIComponent(id)}`, {
      method: 'PUT',
      body: JSON.stringify(body),
      headers: { 'Content-Type': 'application/json', ...(etag ? { 'If-Match': etag } : { 'If-None-Match': '*' }) },
    });
    return etagOf(reply);
  }

  async create(body: SceneJson): Promise<{ id: string; etag: string | null }> {
    const reply = await this.request('/v1/scenes', {
      method: 'POST',
      body: JSON.stringify(body),
      headers: { 'Content-Type': 'application/json' },
    });
    const at = reply.headers.get('location')?.split('/').pop();
    const json = (await reply.json().catch(() => null)) as { id?: string } | null;
    return { id: json?.id ?? at ?? '', etag: etagOf(reply) };
  }

  /** A copy on the server under a new name. */
  async duplicate(id: string, name: string): Promise<{ id: string }> {
    const reply = await this.request(`/v1/scenes/${encodeURIComponent(id)}/duplicate`, {
      method: 'POST',
      body: JSON.stringify({ name }),
      headers: { 'Content-Type': 'application/json' },
    });
    return (await reply.json()) as { id: string };
  }

  /** Changes what the server notes beside the content of a scene. */
  async patch(id: string, change: SceneItemChange, etag: string): Promise<string | null> {
    const reply = await this.request(`/v1/scenes/${encodeURIComponent(id)}`, {
      method: 'PATCH',
      body: JSON.stringify(change),
      headers: { 'Content-Type': 'application/merge-patch+json', 'If-Match': etag },
    });
    return etagOf(reply);
  }

  async remove(id: string, etag: string): Promise<void> {
    await this.request(`/v1/scenes/${encodeURIComponent(id)}`, { method: 'DELETE', headers: { 'If-Match': etag } });
  }

  async score(body: unknown, signal?: AbortSignal): Promise<ScoreReply> {
    const reply = await this.request('/v1/score', {
      method: 'POST',
      body: JSON.stringify(body),
      headers: { 'Content-Type': 'application/json' },
      signal,
    });
    return (await reply.json()) as ScoreReply;
  }

  /** Places road users on the lanes of a scene; nothing is stored. */
  async place(body: unknown, signal?: AbortSignal): Promise<PlaceReply> {
    const reply = await this.request('/v1/place', {
      method: 'POST',
      body: JSON.stringify(body),
      headers: { 'Content-Type': 'application/json' },
      signal,
    });
    return (await reply.json()) as PlaceReply;
  }

  /** Draws a map from a template; nothing is stored. */
  async makeMap(template: TemplateName, parameters: Parameters | null): Promise<MapReply> {
    const reply = await this.request('/v1/map', {
      method: 'POST',
      body: JSON.stringify({ template, ...(parameters ? { parameters } : {}) }),
      headers: { 'Content-Type': 'application/json' },
    });
    return (await reply.json()) as MapReply;
  }

  /** File formats of the server; constant while it runs. */
  async formats(): Promise<readonly FormatInfo[]> {
    const reply = await this.request('/v1/info');
    return ((await reply.json()) as { formats: FormatInfo[] }).formats;
  }

  async exportScene(body: SceneJson, format: string): Promise<{ blob: Blob; name: string; loss: string | null }> {
    const reply = await this.request(`/v1/export?format=${format}`, {
      method: 'POST',
      body: JSON.stringify(body),
      headers: { 'Content-Type': 'application/json' },
    });
    const name = /filename="?([^";]+)/.exec(reply.headers.get('content-disposition') ?? '')?.[1] ?? `scene.${format}`;
    return { blob: await reply.blob(), name, loss: reply.headers.get('dragtraffic-losses') };
  }

  /** Does the server answer? A hanging server accepts the connection and sends nothing, hence the limit. */
  async answers(limit_ms = 3000): Promise<boolean> {
    try {
      await this.request('/healthz', { signal: AbortSignal.timeout(limit_ms), cache: 'no-store' });
      return true;
    } catch (e) {
      return !(e instanceof Away);
    }
  }
}
