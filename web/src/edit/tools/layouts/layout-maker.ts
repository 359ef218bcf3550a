// Requests the map whenever the settings change, and makes a scene of it.
import { effect } from '@preact/signals-core';
import { JUDGING } from '../../../model/base/domain';
import { drivingSide, type DrivingSide } from '../../../model/physics/driving-side';
import { nearestLanes } from '../../../model/document/lanemap';
import { TEMPLATE_TITLES } from '../../../model/document/layouts';
import { isMapRef, type AgentJson, type SceneJson } from '../../../model/document/scene-json';
import { readScene } from '../../../model/document/scene-reader';
import { startPose } from '../../../model/document/scene';
import { Away, Refused, type Client } from '../../../net/client';
import { inWords } from '../../../net/refusal';
import { keep, recall } from '../../../net/storage';
import type { Layout, Parameters, TemplateName } from '../../../net/types';
import type { Editor } from '../../session/editor';
import type { SessionPart } from '../../session/part';
import type { LateTools } from './late-tools';
import type { Layouts, MapWish } from './layouts';
import type { SceneCare } from '../../document/scene-care';
import type { SceneFile } from '../../document/scene-file';
import { TEXTS } from '../../../texts/editing/map-making';

const FIRST_TEMPLATE: TemplateName = 'four-arms';
/** An unreachable server is retried after this. */
const AGAIN_MS = 2000;

export class LayoutMaker implements SessionPart {
  /** One request under way, and the newest that waits. */
  #running = false;
  #waiting: MapWish | null = null;

  constructor(
    private readonly editor: Editor,
    private readonly layouts: Layouts,
    private readonly late: LateTools,
    private readonly file: SceneFile,
    private readonly care: SceneCare,
    private readonly client: Client,
  ) {
    effect(() => {
      const wish = layouts.wish.value;
      if (!wish) this.#waiting = null;
      else if (!layouts.isDrawn(wish)) this.#ask(wish);
    });
  }

  /** Another scene was opened. */
  opened(): void {
    this.leave();
  }

  /** Begins a new map, from the last chosen template. */
  begin(): void {
    this.#open();
    this.layouts.choose(recall<TemplateName>('template') ?? FIRST_TEMPLATE, this.traffic);
  }

  choose(template: TemplateName): void {
    const { layouts } = this;
    keep('template', template);
    // A driving side set by the user stays.
    layouts.choose(template, layouts.parameters.peek()?.traffic ?? this.traffic);
  }

  /** The layout of the open scene's map; null where it came from elsewhere. */
  get madeFrom(): Layout | null {
    const layout = this.file.raw?.x_layout as Layout | undefined;
    return layout?.template && layout.parameters ? layout : null;
  }

  /** The driving side of the open scene: a new map uses it too. */
  get traffic(): DrivingSide | undefined {
    const scene = this.editor.scene.peek();
    return (scene && drivingSide(scene.map, this.madeFrom)) ?? undefined;
  }

  /** Edits the map of the open scene. */
  change(): void {
    const base = this.file.complete();
    const layout = this.madeFrom;
    if (!base || !layout) return;
    this.#open();
    this.layouts.change(layout, base);
  }

  /** Closes the map editor; changes can be reopened. */
  leave(): void {
    const reopen = this.layouts.close();
    if (reopen) this.#offerToGoOn(reopen);
  }

  #offerToGoOn(reopen: () => void): void {
    const { notices } = this.editor;
    const run = (): void => {
      notices.hide();
      this.#open();
      reopen();
    };
    notices.show({ text: TEXTS.mapClosed, action: { label: TEXTS.keepEditing, run } });
  }

  #open(): void {
    const { editor } = this;
    editor.playhead.pause();
    editor.chooseTool('select');
    editor.select(null);
    void this.late.fetch().then((come) => {
      if (!come) editor.notices.say(TEXTS.theHandlesOf);
    });
  }

  #ask(wish: MapWish): void {
    if (this.#running) {
      this.#waiting = wish;
      return;
    }
    void this.#run(wish);
  }

  async #run(first: MapWish): Promise<void> {
    const { layouts } = this;
    this.#running = true;
    layouts.ask();
    for (let wish: MapWish | null = first; wish; wish = this.#next()) {
      try {
        const began = performance.now();
        const reply = await this.client.makeMap(
          wish.template,
          wish.parameters ?? (wish.traffic ? { traffic: wish.traffic } : null),
        );
        // A reply for a closed or replaced template is not shown.
        if (layouts.wish.peek()?.template === wish.template) layouts.settle(wish, reply, performance.now() - began);
      } catch (e) {
        if (!(e instanceof Refused) && !(e instanceof Away)) throw e;
        if (e instanceof Away) this.#askAgain(wish);
        else if (layouts.wish.peek() === wish) layouts.refuse(inWords(e.problem));
      }
    }
    this.#running = false;
  }

  #askAgain(wish: MapWish): void {
    const { layouts } = this;
    layouts.unanswered(TEXTS.theServerIsNot);
    setTimeout(() => {
      if (layouts.wish.peek() === wish) this.#ask(wish);
    }, AGAIN_MS);
  }

  #next(): MapWish | null {
    const next = this.#waiting;
    this.#waiting = null;
    return next;
  }

  /** For pictures of templates. */
  async preview(template: TemplateName, parameters: Parameters | null = null): Promise<SceneJson> {
    return (await this.client.makeMap(template, parameters)).scene as unknown as SceneJson;
  }

  /** Makes a new scene of the map; the scene whose map was edited stays. */
  async use(): Promise<void> {
    const { layouts } = this;
    const made = layouts.made.peek();
    const base = layouts.base;
    if (!made || layouts.asking.peek()) return;
    layouts.close();
    if (!base) return this.care.newOnMap(made.json, TEMPLATE_TITLES[made.layout.template]);
    const agents: AgentJson[] = base.agents;
    const body: SceneJson = { ...base, map: made.json.map, signals: made.json.signals, agents, generated: null };
    // Rules of lanes belong to the map before.
    Object.assign(body, { x_layout: made.layout, x_editor: { ...base.x_editor, lanes_were: undefined } });
    const lost = offTheLanes(body);
    const said = lost.length ? TEXTS.noLongerOnALane(lost.length, lost.slice(0, 5).join(', ')) : '';
    return this.care.newOnMap(body, TEXTS.otherMap(base.name), said);
  }
}

/** Names of vehicles and cyclists that stand on no lane. */
function offTheLanes(json: SceneJson): string[] {
  if (isMapRef(json.map)) return [];
  const scene = readScene(json);
  return [...scene.agents.values()]
    .filter((a) => {
      const p = startPose(a);
      if (!p || a.parked || a.type === 'pedestrian' || a.type === 'other') return false;
      return !nearestLanes(scene.map, p.x, p.y, null, JUDGING.on_lane_m, (l) => l.kind !== 'walk').length;
    })
    .map((a) => a.name);
}
