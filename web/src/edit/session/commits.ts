// Commits changes of the document; every joined part follows in the same batch.
import { batch } from '@preact/signals-core';
import type { Command } from '../../model/document/commands';
import type { Scene } from '../../model/document/scene';
import type { HistoryDirection } from '../../model/document/scene-diff';
import type { Commit, Document, Lock, Travel } from '../document/document';
import { stepOf } from '../document/step';
import { TEXTS } from '../../texts/editing/generation';
import type { Notices } from './notices';
import type { SessionPart } from './part';

export class Commits {
  constructor(
    private readonly document: Document,
    private readonly notices: Notices,
    /** Parts that follow, in this order. */
    private readonly parts: readonly SessionPart[],
    /** Do the answers belong to the document? */
    private readonly isAnswered: () => boolean,
  ) {}

  /** Runs a command as one undo step. A running drag is released first: the command may build on its preview. */
  run(command: Command): void {
    this.#commit(null, () => this.document.run(command));
  }

  undo(): void {
    this.#travel('back', () => this.document.undo());
  }

  redo(): void {
    this.#travel('forth', () => this.document.redo());
  }

  /** Goes to any step of the history; null for the scene before the first. */
  goTo(id: number | null): void {
    if (id === this.document.history?.head && !this.document.trial.peek()) return;
    const name = this.document.history?.step(id)?.name ?? TEXTS.backToTheBeginning;
    const commit = this.#commit('there', () => {
      const there = this.document.goTo(id);
      return there && { ...there, name };
    });
    if (commit) this.notices.say(TEXTS.nowAt(name));
  }

  /** Replaces the document with another version of the same scene; undo restores this one. */
  adopt(name: string, scene: Scene): void {
    this.#commit('there', () => this.document.adopt(name, scene));
  }

  /** Ends the running drag with a command as its step, or without one. */
  release(command: Command | null): void {
    if (command) this.#follow(null, () => this.document.commit(command));
    else this.document.cancel();
    this.document.settle();
  }

  /** A change was tried that is not possible now: reports why. */
  refused(): boolean {
    const lock: Lock | null = this.document.lock.peek();
    if (lock) this.notices.show({ text: lock.words, action: lock });
    return lock !== null;
  }

  #travel(way: HistoryDirection, move: () => Travel | null): void {
    const travel = this.#commit(way, move);
    if (!travel) return;
    for (const part of this.parts) part.travelled?.(travel.step, way);
    const word = way === 'back' ? TEXTS.undone : TEXTS.redone;
    this.notices.show({ text: `${word}: ${travel.name}.` });
    this.notices.say(`${word}: ${travel.name}.`);
  }

  /**
   * `way`: direction in the history; null for a new step. A running drag is released before `move`, so that its change
   * is kept.
   */
  #commit<C extends Commit>(way: HistoryDirection | 'there' | null, move: () => C | null): C | null {
    if (!this.document.scene.peek() || this.refused()) return null;
    const trial = this.document.trial.peek();
    if (trial) this.release(trial.command);
    return this.#follow(way, move);
  }

  /** All parts follow a commit in one batch. */
  #follow<C extends Commit>(way: HistoryDirection | 'there' | null, move: () => C | null): C | null {
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
