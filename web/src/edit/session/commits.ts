// Changes of the document, and everything that follows from one: whoever follows a change does so at once with it.
import { batch } from '@preact/signals-core';
import type { Command } from '../../model/document/commands';
import type { Scene } from '../../model/document/scene';
import type { Way } from '../../model/document/scene-diff';
import type { Commit, Document, Lock, Travel } from '../document/document';
import { stepOf } from '../document/step';
import { TEXTS } from '../../texts/editing/generation';
import type { Notices } from './notices';
import type { Part } from './part';

export class Commits {
  constructor(
    private readonly document: Document,
    private readonly notices: Notices,
    /** Who follows, in this order. */
    private readonly parts: readonly Part[],
    /** Are the answers those of the document? */
    private readonly isAnswered: () => boolean,
  ) {}

  /** Does a command as one undo step. A drag that goes on is released first: the command may go on from its preview. */
  run(command: Command): void {
    this.#commit(null, () => this.document.run(command));
  }

  undo(): void {
    this.#travel('back', () => this.document.undo());
  }

  redo(): void {
    this.#travel('forth', () => this.document.redo());
  }

  /** To any step of the history; null for how the scene was before the first. */
  goTo(id: number | null): void {
    if (id === this.document.history?.head && !this.document.trial.peek()) return;
    const name = this.document.history?.step(id)?.name ?? TEXTS.backToTheBeginning;
    const commit = this.#commit('there', () => {
      const there = this.document.goTo(id);
      return there && { ...there, name };
    });
    if (commit) this.notices.say(TEXTS.nowAt(name));
  }

  /** Another version of the same scene takes the place of this one; undo brings this one back. */
  adopt(name: string, scene: Scene): void {
    this.#commit('there', () => this.document.adopt(name, scene));
  }

  /** Ends the drag that goes on with a command as its step, or without one. */
  release(command: Command | null): void {
    if (command) this.#follow(null, () => this.document.commit(command));
    else this.document.cancel();
    this.document.settle();
  }

  /** A change was tried that cannot be made now: says why. */
  refused(): boolean {
    const lock: Lock | null = this.document.lock.peek();
    if (lock) this.notices.show({ text: lock.words, action: lock });
    return lock !== null;
  }

  #travel(way: Way, move: () => Travel | null): void {
    const travel = this.#commit(way, move);
    if (!travel) return;
    for (const part of this.parts) part.travelled?.(travel.step, way);
    const word = way === 'back' ? TEXTS.undone : TEXTS.redone;
    this.notices.show({ text: `${word}: ${travel.name}.` });
    this.notices.say(`${word}: ${travel.name}.`);
  }

  /**
   * `way`: where one travels in the history; null for a new step. A drag that goes on is released before `move`, so
   * that nothing of it is lost.
   */
  #commit<C extends Commit>(way: Way | 'there' | null, move: () => C | null): C | null {
    if (!this.document.scene.peek() || this.refused()) return null;
    const trial = this.document.trial.peek();
    if (trial) this.release(trial.command);
    return this.#follow(way, move);
  }

  /** Everything else follows a commit, all at once. */
  #follow<C extends Commit>(way: Way | 'there' | null, move: () => C | null): C | null {
    const done = batch(() => {
      const commit = move();
      if (!commit) return null;
      const { before, after } = commit;
      const step = stepOf(commit, way, before.thresholds !== after.thresholds && this.isAnswered());
      for (const part of this.parts) part.followed?.(commit, step, way);
      return { commit, step };
    });
    if (!done) return null;
    for (const part of this.parts) part.committed?.(done.commit.after, done.step);
    return done.commit;
  }
}
