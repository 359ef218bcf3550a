// Plain requests to the server. Every failure is one of two things: an answer that says no (`Refused`), or no
// answer at all (`Away`).
import { problemOf } from './problem';
import { inWords } from './refusal';
import type {
  ImportReply,
  MapReply,
  Parameters,
  PlaceReply,
  Problem,
  SceneJson,
  SceneList,
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

/** The version of a scene, however it travelled: compressed replies mark theirs. */
const etagOf = (reply: Response): string | null => reply.headers.get('etag')?.replace(/-gzip"$/, '"') ?? null;

/** Gateway errors and "shutting down" mean the generator is away; "busy" is an answer, and passes. */
const isAway = (status: number): boolean => status === 502 || status === 503 || status === 504;

/** What comes with a file. */
export interface Beside {
  /** The network or map that it belongs to. */
  readonly net?: Blob;
  /** What the columns of a table say. */
  readonly columns?: Record<string, unknown>;
}

export class Client {
  constructor(
    private readonly base = '',
    private readonly fetcher: typeof fetch = (...a) => fetch(...a),
  ) {}

  /** The bare answer, whatever it says; `request` sorts out those that say no. */
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

  async scenes(query = ''): Promise<SceneList> {
    const all: SceneList = { scenes: [], next: null };
    let after: string | null = null;
    do {
      const p = new URLSearchParams({ limit: '200', ...(query ? { q: query } : {}), ...(after ? { after } : {}) });
      const page = (await (await this.request(`/v1/scenes?${p}`)).json()) as SceneList;
      all.scenes.push(...page.scenes);
      after = page.next;
    } while (after && all.scenes.length < 2000);
    return all;
  }

  async scene(id: string): Promise<{ json: SceneJson; etag: string | null }> {
    const reply = await this.request(`/v1/scenes/${encodeURIComponent(id)}`);
    return { json: (await reply.json()) as SceneJson, etag: etagOf(reply) };
  }

  /** What a small picture of a scene shows; the browser keeps it until the scene changes. */
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

  /** A copy on the server under a name of its own. */
  async duplicate(id: string, name: string): Promise<{ id: string }> {
    const reply = await this.request(`/v1/scenes/${encodeURIComponent(id)}/duplicate`, {
      method: 'POST',
      body: JSON.stringify({ name }),
      headers: { 'Content-Type': 'application/json' },
    });
    return (await reply.json()) as { id: string };
  }

  async rename(id: string, name: string, etag: string): Promise<string | null> {
    const reply = await this.request(`/v1/scenes/${encodeURIComponent(id)}`, {
      method: 'PATCH',
      body: JSON.stringify({ name }),
      headers: { 'Content-Type': 'application/merge-patch+json', 'If-Match': etag },
    });
    return etagOf(reply);
  }

  async remove(id: string, etag: string): Promise<void> {
    await this.request(`/v1/scenes/${encodeURIComponent(id)}`, { method: 'DELETE', headers: { 'If-Match': etag } });
  }

  async importFile(name: string, body: Blob, { net, columns }: Beside = {}): Promise<ImportReply> {
    const isJson = /\.json$/i.test(name);
    const form = new FormData();
    form.append('file', body, name);
    if (net) form.append('net', net);
    if (columns) form.append('columns', new Blob([JSON.stringify(columns)], { type: 'application/json' }));
    const type = isJson ? 'application/json' : 'application/octet-stream';
    const reply = await this.request(`/v1/import?name=${encodeURIComponent(name.slice(-120))}`, {
      method: 'POST',
      ...(net || columns ? { body: form } : { body, headers: { 'Content-Type': type } }),
    });
    return (await reply.json()) as ImportReply;
  }

  /** Reads a scene as a file is read, and stores nothing. */
  async tryImport(scene: SceneJson): Promise<ImportReply> {
    const reply = await this.request('/v1/import?dry_run=true&format=dragtraffic', {
      method: 'POST',
      body: JSON.stringify(scene),
      headers: { 'Content-Type': 'application/json' },
    });
    return (await reply.json()) as ImportReply;
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

  /** Road users put on the lanes of a scene; nothing is stored. */
  async place(body: unknown, signal?: AbortSignal): Promise<PlaceReply> {
    const reply = await this.request('/v1/place', {
      method: 'POST',
      body: JSON.stringify(body),
      headers: { 'Content-Type': 'application/json' },
      signal,
    });
    return (await reply.json()) as PlaceReply;
  }

  /** A map drawn from a template; nothing is stored. */
  async makeMap(template: TemplateName, parameters: Parameters | null): Promise<MapReply> {
    const reply = await this.request('/v1/map', {
      method: 'POST',
      body: JSON.stringify({ template, ...(parameters ? { parameters } : {}) }),
      headers: { 'Content-Type': 'application/json' },
    });
    return (await reply.json()) as MapReply;
  }

  /** What files the server reads and writes; they are the same as long as it runs. */
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

  /** Does anybody answer? A server that hangs takes the connection and says nothing, hence the limit. */
  async answers(limit_ms = 3000): Promise<boolean> {
    try {
      await this.request('/healthz', { signal: AbortSignal.timeout(limit_ms), cache: 'no-store' });
      return true;
    } catch (e) {
      return !(e instanceof Away);
    }
  }
}
