// Asks the server who would stand where, as often as the wish changes, and adds them when that is wanted.
import { effect } from '@preact/signals-core';
import type { Scene } from '../model/document/scene';
import { inOneStep, removeAgents } from '../model/document/commands';
import { Away, Refused, type Client } from '../net/client';
import type { Editor } from './editor';
import type { Answers } from './fill-answer';
import { NO_ANSWER, type FillWish } from './filling';
import type { SceneFile } from './document/scene-file';
import { addThem, tooMany } from './several';
import { TEXTS } from '../texts/editing/keeping';

/** A slider that moves asks when it rests so long. */
const REST_MS = 80;

export class Filler {
  #rest: ReturnType<typeof setTimeout> | undefined;
  #abort: AbortController | null = null;
  #answers: Answers | null = null;

  constructor(
    private readonly editor: Editor,
    private readonly file: SceneFile,
    private readonly client: Client,
  ) {
    let asked = '';
    effect(() => {
      const wish = editor.filling.wish.value;
      const scene = editor.scene.value;
      clearTimeout(this.#rest);
      if (!wish || !scene) {
        asked = '';
        this.#abort?.abort();
        return;
      }
      // Whoever is pinned stands where the answer had it already: nothing changes until something else does.
      const { pinned, ...rest } = wish;
      const now = JSON.stringify([rest, scene.id, scene.roster]);
      if (now === asked) return;
      asked = now;
      editor.filling.ask();
      this.#rest = setTimeout(() => void this.#ask(scene, { ...rest, pinned }), REST_MS);
    });
  }

  async #ask(scene: Scene, wish: FillWish): Promise<void> {
    const { filling } = this.editor;
    this.#abort?.abort();
    const abort = (this.#abort = new AbortController());
    try {
      const { Answers } = await import('./fill-answer');
      this.#answers ??= new Answers(this.file, this.client);
      const answer = await this.#answers.to(scene, wish, abort.signal);
      if (!abort.signal.aborted) filling.settle(answer);
    } catch (e) {
      if (abort.signal.aborted) return;
      const reason = e instanceof Refused ? e.message : TEXTS.theGenerator;
      // A part of the page that does not come is a matter of the network too.
      if (!(e instanceof Refused) && !(e instanceof Away) && !(e instanceof TypeError)) throw e;
      filling.settle({ ...NO_ANSWER, reason });
    }
  }

  /** What is previewed comes into the scene: one step. */
  add(): void {
    const { editor } = this;
    const { filling, notices } = editor;
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
    editor.setTime(0);
    const come = addThem(scene, all, 'placed');
    editor.chooseTool('select');
    editor.run(gone.length ? inOneStep(removeAgents(scene, gone, ''), come, come.name) : come);
    if (answer.reason) notices.show({ text: TEXTS.roadUsersPlaced(all.length, answer.reason), undo: true });
  }
}
