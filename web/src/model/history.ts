// Undo and redo. A drag is a transaction: previews replace each other, the release commits one step.
import type { Command } from './commands';
import type { Scene } from './scene';

interface Step {
  readonly name: string;
  readonly back: Command;
  readonly forth: Command;
  fold?: string;
  at: number;
}

const FOLD_MS = 600;

export class History {
  private done: Step[] = [];
  private undone: Step[] = [];
  private base: Scene | null = null;

  constructor(
    public scene: Scene,
    private readonly now: () => number = () => Date.now(),
  ) {}

  get undoName(): string | null {
    return this.done.at(-1)?.name ?? null;
  }
  get redoName(): string | null {
    return this.undone.at(-1)?.name ?? null;
  }
  get depth(): number {
    return this.done.length;
  }

  /** Does a command; key repeats on the same field within 600 ms fold into one step. */
  run(command: Command): Scene {
    const before = this.scene;
    this.scene = command.apply(before);
    if (this.scene === before) return before;
    const step: Step = {
      name: command.name,
      back: command.invert(before),
      forth: command,
      fold: command.fold,
      at: this.now(),
    };
    const last = this.done.at(-1);
    const folds =
      last && command.fold && last.fold === command.fold && step.at - last.at < FOLD_MS && !this.undone.length;
    if (folds) this.done[this.done.length - 1] = { ...step, back: last.back };
    else this.done.push(step);
    this.undone = [];
    return this.scene;
  }

  begin(): void {
    this.base = this.scene;
  }

  preview(command: Command): Scene {
    if (!this.base) this.begin();
    this.scene = command.apply(this.base!);
    return this.scene;
  }

  /** Ends the transaction with one undo step; nothing is written when nothing changed. */
  commit(command: Command): Scene {
    if (this.base) this.scene = this.base;
    this.base = null;
    return this.run({ ...command, fold: undefined });
  }

  cancel(): Scene {
    if (this.base) this.scene = this.base;
    this.base = null;
    return this.scene;
  }

  undo(): Step | null {
    const step = this.done.pop();
    if (!step) return null;
    this.scene = step.back.apply(this.scene);
    this.undone.push(step);
    return step;
  }

  redo(): Step | null {
    const step = this.undone.pop();
    if (!step) return null;
    this.scene = step.forth.apply(this.scene);
    this.done.push({ ...step, fold: undefined });
    return step;
  }
}
