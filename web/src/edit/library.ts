// The scenes: list, open, save, import. Own scenes are saved to the server after every step; edits of example
// scenes stay in this browser until a copy is made.
import { signal } from '@preact/signals-core';
import type { Editor } from './editor';
import { Away, Refused, type Client } from '../net/client';
import type { SceneListItem } from '../net/types';
import { forget, keep, recall } from '../net/storage';
import { isMapRef, type MapJson, type SceneJson } from '../model/json';
import { readGenerated, readScene, SceneError } from '../model/read';
import { generatedJson, writeScene } from '../model/write';
import { sceneKey, touched, withAgents, type Agent, type Scene } from '../model/scene';

export type SaveState = 'example' | 'saved' | 'saving' | 'local' | 'conflict' | 'full';

interface KeptAgent {
  id: string;
  start: Agent['start'];
  goal: Agent['goal'];
  chosen: number | null;
  length: number;
  width: number;
}
interface KeptEdits {
  agents: KeptAgent[];
  seed: number;
  diversity: number;
  others: Scene['others'];
}

export interface Verdict {
  readonly file: string;
  readonly ok: boolean;
  readonly scenes: readonly { id: string; name: string; count: number | null }[];
  readonly wrong?: string;
  readonly where?: string;
  readonly todo?: string;
  readonly details?: string;
}

const SAVE_DELAY_MS = 300;
/** Examples in the order in which they are best met, last first. */
const FIRST = ['demo-motorway', 'demo-arterial', 'demo-residential', 'demo-roundabout', 'demo-crossing'];

export class Library {
  readonly list = signal<readonly SceneListItem[]>([]);
  readonly listed = signal(false);
  readonly saveState = signal<SaveState>('example');
  readonly conflict = signal<{ etag: string | null } | null>(null);
  readonly imports = signal<readonly Verdict[] | null>(null);
  readonly openError = signal<string | null>(null);
  raw: SceneJson | null = null;
  mapJson: MapJson | null = null;
  mapRef: string | null = null;
  /** The server knows this scene by its id. */
  stored = false;
  /** The document as it was opened: nothing to save yet. */
  private opened: Scene | null = null;
  private etag: string | null = null;
  private saveTimer = 0;
  private saving = false;
  private again = false;
  private withConditions = new Set<string>();
  /** Called when another scene is on screen. */
  onOpen: ((scene: Scene) => void) | null = null;

  constructor(
    private readonly editor: Editor,
    private readonly client: Client,
  ) {}

  hadConditions(id: string): boolean {
    return this.withConditions.has(id);
  }

  async refresh(): Promise<void> {
    try {
      // Own scenes first, newest on top, then the examples, then what was recorded.
      const rank = (s: SceneListItem): number =>
        s.readonly !== true && !s.id.startsWith('demo-') ? 0 : s.id.startsWith('demo-') ? 1 : 2;
      this.list.value = (await this.client.scenes()).scenes
        .map((s, i) => ({ s, i }))
        .sort(
          (a, b) =>
            rank(a.s) - rank(b.s) || (rank(a.s) === 1 ? FIRST.indexOf(b.s.id) - FIRST.indexOf(a.s.id) : 0) || a.i - b.i,
        )
        .map((p) => p.s);
    } finally {
      this.listed.value = true;
    }
  }

  isOwn(id: string): boolean {
    const item = this.list.peek().find((s) => s.id === id);
    return item ? item.readonly !== true && !id.startsWith('demo-') : !id.startsWith('demo-');
  }

  async open(id: string): Promise<void> {
    this.openError.value = null;
    try {
      const { json, etag } = await this.client.scene(id);
      const map = isMapRef(json.map) ? await this.client.map(json.map.ref) : json.map;
      this.adopt({ ...json, id: json.id ?? id }, map, etag, true);
      const sha = this.list.peek().find((s) => s.id === id)?.map_sha256;
      this.mapRef = isMapRef(json.map)
        ? json.map.ref
        : sha
          ? sha.startsWith('sha256:')
            ? sha
            : `sha256:${sha}`
          : null;
      if (!this.mapRef) this.mapRef = await this.client.mapRef(id).catch(() => null);
    } catch (e) {
      this.openError.value =
        e instanceof SceneError || e instanceof Refused
          ? e.message
          : 'The scene could not be loaded. The server is not answering.';
      if (!(e instanceof SceneError || e instanceof Refused || e instanceof Away)) throw e;
    }
  }

  private adopt(json: SceneJson, map: MapJson, etag: string | null, stored: boolean): void {
    let scene = readScene(json, map);
    this.raw = json;
    this.mapJson = map;
    this.stored = stored;
    this.etag = etag;
    this.mapRef = null;
    this.withConditions = new Set(
      json.agents.filter((a) => a.conditions && Object.keys(a.conditions).length).map((a) => a.id),
    );
    this.conflict.value = null;
    const kept = recall<KeptEdits>(`edits:${scene.id}`);
    if (kept) scene = restore(scene, kept);
    this.saveState.value = this.isOwn(scene.id) ? (kept ? 'local' : 'saved') : kept ? 'local' : 'example';
    keep('last-scene', scene.id);
    this.opened = kept ? null : scene;
    const saved = kept ? null : readGenerated(json, scene);
    this.editor.open(scene, saved);
    const unanswered = !saved && [...scene.agents.values()].some(touched);
    if (unanswered) this.editor.motion.value = { ...this.editor.motion.peek(), stale: true };
    this.onOpen?.(scene);
    if (unanswered) this.editor.onCommit?.(scene, { name: 'Scene opened', agent: null, undo: true });
    if (kept) {
      this.editor.notify(
        {
          text: 'Your changes from last time are back.',
          action: { label: 'Start fresh', run: () => void this.startFresh(scene.id) },
        },
        9000,
      );
    }
  }

  async startFresh(id: string): Promise<void> {
    forget(`edits:${id}`);
    await this.open(id);
  }

  /** A document change was committed. */
  changed(scene: Scene): void {
    if (!this.raw || scene === this.opened) return;
    const id = scene.id;
    const kept = keptEdits(scene);
    if (kept ? !keep(`edits:${id}`, kept) : (forget(`edits:${id}`), false)) this.saveState.value = 'full';
    else if (!this.isOwn(id)) this.saveState.value = kept ? 'local' : 'example';
    if (this.isOwn(id) && this.stored) {
      this.saveState.value = 'saving';
      clearTimeout(this.saveTimer);
      this.saveTimer = setTimeout(() => void this.save(), SAVE_DELAY_MS) as unknown as number;
    }
  }

  /** The generator is back: what could not be saved is saved now. */
  retry(): void {
    if (this.raw && this.stored && this.isOwn(this.raw.id ?? '') && this.saveState.peek() !== 'saved') void this.save();
  }

  current(): SceneJson | null {
    const scene = this.editor.scene.peek();
    if (!scene || !this.raw) return null;
    const m = this.editor.motion.peek();
    const driving = [...m.futures].filter(([id]) => m.driving.has(id));
    return writeScene(
      this.raw,
      scene,
      m.stale ? null : generatedJson(scene, driving, m.head),
      this.mapRef ? { ref: this.mapRef } : (this.mapJson ?? undefined),
    );
  }

  /** The same with the map inside: for files and for servers that do not know the map. */
  complete(): SceneJson | null {
    const json = this.current();
    return json && this.mapJson ? { ...json, map: this.mapJson } : json;
  }

  private async save(force = false): Promise<void> {
    if (this.saving) {
      this.again = true;
      return;
    }
    const scene = this.editor.scene.peek();
    const body = this.current();
    if (!scene || !body) return;
    this.saving = true;
    this.again = false;
    const key = sceneKey(scene) + scene.name;
    try {
      this.etag = await this.put(scene.id, body, force);
      this.withConditions = new Set(
        body.agents.filter((a) => a.conditions && Object.keys(a.conditions).length).map((a) => a.id),
      );
      const now = this.editor.scene.peek();
      if (now && sceneKey(now) + now.name === key) {
        forget(`edits:${scene.id}`);
        this.saveState.value = 'saved';
      }
      void this.refresh().catch(() => undefined);
    } catch (e) {
      if (e instanceof Refused && e.status === 412) {
        this.conflict.value = { etag: e.problem.etag ?? null };
        this.saveState.value = 'conflict';
      } else this.saveState.value = 'local';
    } finally {
      this.saving = false;
      if (this.again && this.saveState.peek() !== 'conflict') void this.save();
    }
  }

  private async put(id: string, body: SceneJson, force: boolean): Promise<string | null> {
    const etag = force ? (this.conflict.peek()?.etag ?? (await this.client.scene(id)).etag) : this.etag;
    try {
      return await this.client.save(id, body, etag);
    } catch (e) {
      if (e instanceof Refused && e.problem.code === 'unknown-map') return this.client.save(id, this.complete()!, etag);
      throw e;
    }
  }

  /** Conflict: this version replaces the other one. */
  async keepMine(): Promise<void> {
    await this.save(true);
    if (this.saveState.peek() === 'saved') this.conflict.value = null;
  }

  /** Conflict: the other version replaces this one. */
  async takeTheirs(): Promise<void> {
    const id = this.editor.scene.peek()?.id;
    if (!id) return;
    forget(`edits:${id}`);
    this.conflict.value = null;
    await this.open(id);
  }

  /** An own copy of what is on screen; from then on it saves itself. */
  async saveCopy(): Promise<void> {
    const scene = this.editor.scene.peek();
    const body = this.complete();
    if (!scene || !body) return;
    const name = this.isOwn(scene.id) ? `${scene.name}, copy` : `${scene.name}, edited`;
    try {
      const { id } = await this.client.create({ ...body, name });
      await this.refresh().catch(() => undefined);
      forget(`edits:${scene.id}`);
      await this.open(id);
      this.editor.notify({ text: `Saved as “${name}”.` });
    } catch (e) {
      this.editor.notify({
        text:
          e instanceof Refused
            ? `Not saved: ${e.message}`
            : 'Not saved: the server is not answering. Your changes are kept on this computer.',
      });
    }
  }

  async remove(id: string): Promise<void> {
    const item = this.list.peek().find((s) => s.id === id);
    try {
      const etag = item?.etag ?? (await this.client.scene(id)).etag ?? '*';
      await this.client.remove(id, etag);
      forget(`edits:${id}`);
      await this.refresh();
      this.editor.notify({ text: `“${item?.name ?? id}” deleted.` });
      if (this.editor.scene.peek()?.id === id && this.list.peek()[0]) await this.open(this.list.peek()[0].id);
    } catch (e) {
      this.editor.notify({ text: `Not deleted: ${(e as Error).message}` });
    }
  }

  async importFiles(files: readonly File[]): Promise<void> {
    const verdicts: Verdict[] = [];
    this.editor.notify(
      { text: files.length === 1 ? `Reading ${files[0].name} …` : `Reading ${files.length} files …` },
      120_000,
    );
    for (const f of files) verdicts.push(await this.importOne(f));
    await this.refresh().catch(() => undefined);
    const named = verdicts.map((v) => ({
      ...v,
      scenes: v.scenes.map((s) => ({ ...s, count: s.count ?? countOf(this.list.peek().find((i) => i.id === s.id)) })),
    }));
    const good = named.flatMap((v) => v.scenes);
    const bad = named.filter((v) => !v.ok);
    this.editor.notify(null);
    if (good.length) await this.open(good[0].id);
    if (!bad.length && good.length === 1) this.editor.notify({ text: `${good[0].name} imported.` });
    else this.imports.value = named;
  }

  private async importOne(file: File): Promise<Verdict> {
    try {
      const reply = await this.client.importFile(file.name, file);
      const scenes = reply.scenes.map((s) => ({
        id: s.id ?? '',
        name: s.name,
        count: s.counts ? Object.values(s.counts).reduce((a, b) => a + (b ?? 0), 0) : null,
      }));
      const skipped = reply.skipped ?? [];
      if (!scenes.length) return { file: file.name, ok: false, scenes, ...explain(file.name, skipped[0]?.problem) };
      return skipped.length
        ? {
            file: file.name,
            ok: true,
            scenes,
            wrong: `${skipped.length} of ${scenes.length + skipped.length} scenes in this file could not be read: ${skipped[0].problem.detail ?? skipped[0].problem.title}`,
          }
        : { file: file.name, ok: true, scenes };
    } catch (e) {
      if (e instanceof Refused) return { file: file.name, ok: false, scenes: [], ...explain(file.name, e.problem) };
      return {
        file: file.name,
        ok: false,
        scenes: [],
        wrong: 'The server is not answering.',
        todo: 'Try again when the generator is back. The file was not changed.',
      };
    }
  }
}

const countOf = (i: SceneListItem | undefined): number | null =>
  i?.counts ? Object.values(i.counts).reduce((a, b) => a + (b ?? 0), 0) : null;

function explain(
  file: string,
  p: Refused['problem'] | undefined,
): Pick<Verdict, 'wrong' | 'where' | 'todo' | 'details'> {
  if (!p) return { wrong: 'There is no scene in this file.' };
  const first = p.errors?.[0];
  const where = [file, first?.pointer, p.offset !== undefined ? `byte ${p.offset}` : ''].filter(Boolean).join(', ');
  const todo =
    p.code === 'format-unknown'
      ? 'Scenario records, lane maps and saved scenes can be read. Choose another file.'
      : p.code.includes('too-large') || p.code === 'body-too-large'
        ? 'The file is larger than the server takes. Split it, or use the command line.'
        : p.code === 'unsupported-version'
          ? 'Update this program, or save the scene again with the version you have.'
          : 'Mend the file and drop it again, or choose another one.';
  const wrong =
    p.code === 'format-unknown' ? `“${file}” is not a scene.` : (first?.detail ?? p.reason ?? p.detail ?? p.title);
  return { wrong, where, todo, details: JSON.stringify(p, null, 2) };
}

function keptEdits(scene: Scene): KeptEdits | null {
  const agents = [...scene.agents.values()]
    .filter(touched)
    .map((a) => ({ id: a.id, start: a.start, goal: a.goal, chosen: a.chosen, length: a.length, width: a.width }));
  return agents.length ? { agents, seed: scene.seed, diversity: scene.diversity, others: scene.others } : null;
}

function restore(scene: Scene, kept: KeptEdits): Scene {
  const changed: Agent[] = [];
  for (const k of kept.agents) {
    const a = scene.agents.get(k.id);
    if (a)
      changed.push({
        ...a,
        start: Object.freeze(k.start),
        goal: Object.freeze(k.goal),
        chosen: k.chosen,
        length: k.length,
        width: k.width,
      });
  }
  return Object.freeze({
    ...withAgents(scene, changed),
    seed: kept.seed,
    diversity: kept.diversity,
    others: kept.others,
  });
}
