// Requests a placement whenever the settings change, and adds it to the scene on demand.
import { effect } from '@preact/signals-core';
import type { Scene } from '../../../model/document/scene';
import { inOneStep, removeAgents } from '../../../model/document/commands';
import { Away, Refused, type Client } from '../../../net/client';
import type { Editor } from '../../session/editor';
import type { FillAnswers } from './fill-answer';
import { NO_ANSWER, type Filling, type FillWish } from './filling';
import type { SceneFile } from '../../document/scene-file';
import { addThem, tooMany } from '../../moves/several';
import { TEXTS } from '../../../texts/editing/filling';

/** A moving slider sends a request after this rest. */
const REST_MS = 80;

export class Filler {
  #rest: ReturnType<typeof setTimeout> | undefined;
  #abort: AbortController | null = null;
  #answers: FillAnswers | null = null;

  constructor(
    private readonly editor: Editor,
    private readonly filling: Filling,
    private readonly file: SceneFile,
    private readonly client: Client,
  ) {
    let asked = '';
    effect(() => {
      const wish = filling.wish.value;
      const scene = editor.scene.value;
      clearTimeout(this.#rest);
      if (!wish || !scene) {
        asked = '';
        this.#abort?.abort();
        return;
      }
      // A pinned road user keeps its place: a new request follows only after another change.
      const { pinned, ...rest } = wish;
      const now = JSON.stringify([rest, scene.id, scene.castKey]);
      if (now === asked) return;
      asked = now;
      filling.ask();
      this.#rest = setTimeout(() => void this.#ask(scene, { ...rest, pinned }), REST_MS);
    });
  }

  async #ask(scene: Scene, wish: FillWish): Promise<void> {
    const { filling } = this;
    this.#abort?.abort();
    const abort = (this.#abort = new AbortController());
    try {
      const { FillAnswers } = await import('./fill-answer');
      this.#answers ??= new FillAnswers(this.file, this.client);
      const answer = await this.#answers.to(scene, wish, abort.signal);
      if (!abort.signal.aborted) filling.settle(answer);
    } catch (e) {
      if (abort.signal.aborted) return;
      const reason = e instanceof Refused ? e.message : TEXTS.theGenerator;
      // A module that fails to load counts as a network problem too.
      if (!(e instanceof Refused) && !(e instanceof Away) && !(e instanceof TypeError)) throw e;
      filling.settle({ ...NO_ANSWER, reason });
    }
  }

  /** Adds the preview to the scene: one step. */
  add(): void {
    const { editor, filling } = this;
    const { notices } = editor;
    const scene = editor.scene.peek();
    const answer = filling.answer.peek();
    const all = filling.all.peek();
    if (!scene || !answer || filling.asking.peek()) return;
    const gone = answer.replaced.filter((id) => scene.agents.has(id));
    const full = tooMany(scene, all.length - gone.length);
    if (full || !all.length) {
      notices.show({ text: full ?? answer.reason ?? TEXTS.thereIsNoRoom });
      return;
    }
    editor.playhead.pause();
    editor.playhead.moveTo(0);
    const come = addThem(scene, all, 'placed');
    editor.chooseTool('select');
    editor.commits.run(gone.length ? inOneStep(removeAgents(scene, gone, ''), come, come.name) : come);
    if (answer.reason) notices.show({ text: TEXTS.roadUsersPlaced(all.length, answer.reason), undo: true });
  }
}
