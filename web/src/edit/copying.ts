// Copy, cut, paste, duplicate. What is copied travels as text, so that it can be put into another tab's scene.
import type { Vec } from '../model/base/geometry';
import { copiesText, readCopies, shifted, type Newcomer } from '../model/document/newcomer';
import { wrapAngle } from '../model/base/geometry';
import type { Editor } from './editor';
import { addThem, copiesOf, movable, removeThem, tooMany, whoWords, withRoom } from './several';
import { snapNewcomer } from './placing';
import { TEXTS } from '../texts/editing/moves';

export class Copying {
  /** What was copied here last, for pages that may not read the clipboard. */
  #last: string | null = null;

  constructor(private readonly editor: Editor) {}

  get last(): string | null {
    return this.#last;
  }

  /** Text of who is selected; null where nobody is that could be copied. */
  copy(): string | null {
    const { editor } = this;
    const all = copiesOf(editor.chosenOnes);
    if (!all.length) return null;
    this.#last = copiesText(all);
    const who = whoWords(editor.chosenOnes);
    editor.notices.show({ text: TEXTS.copied(who) });
    editor.notices.say(TEXTS.copied(who));
    return this.#last;
  }

  cut(): string | null {
    const text = this.copy();
    if (text) removeSelected(this.editor);
    return text;
  }

  /** Puts what a text holds into the scene, its middle at a place; false where the text holds nobody. */
  paste(text: string, at: Vec | null, zoom: number): boolean {
    const { editor } = this;
    const scene = editor.scene.peek();
    const copies = readCopies(text);
    if (!copies || !scene) return false;
    const full = tooMany(scene, copies.length);
    if (full) editor.notices.show({ text: full });
    else editor.run(addThem(scene, withRoom(scene, at ? this.#around(copies, at, zoom) : copies), 'pasted'));
    return true;
  }

  #around(copies: readonly Newcomer[], at: Vec, zoom: number): readonly Newcomer[] {
    const mid = (of: (n: Newcomer) => number): number => {
      const v = copies.map(of);
      return (Math.min(...v) + Math.max(...v)) / 2;
    };
    const dx = at[0] - mid((n) => n.pose.x),
      dy = at[1] - mid((n) => n.pose.y);
    const there = copies.map((n) => shifted(n, dx, dy));
    if (there.length !== 1) return there;
    const [one] = there;
    const snapped = snapNewcomer(this.editor.scene.peek()!, one, zoom);
    return [{ ...one, pose: { ...one.pose, ...snapped, heading: wrapAngle(snapped.heading) } }];
  }

  duplicate(): void {
    const { editor } = this;
    const scene = editor.scene.peek();
    const copies = copiesOf(editor.chosenOnes);
    if (!scene || !copies.length) return;
    const full = tooMany(scene, copies.length);
    if (full) editor.notices.show({ text: full });
    else editor.run(addThem(scene, withRoom(scene, copies), 'duplicated'));
  }
}

/** Those who are selected go; who is locked stays. */
export function removeSelected(editor: Editor): void {
  const scene = editor.scene.peek();
  const all = editor.chosenOnes;
  const free = all.filter((a) => !a.locked);
  if (!scene || !all.length) return;
  const stay = all.length - free.length;
  if (!free.length) editor.notices.show({ text: lockedWords(stay) });
  else {
    const command = removeThem(scene, free);
    editor.run(command);
    editor.notices.show({
      text: `${command.name}.${stay ? TEXTS.lockedStay(stay) : ''}`,
      undo: true,
    });
    editor.notices.say(`${command.name}.`);
  }
}

/** What is said where only locked ones were meant. */
export const lockedWords = (n: number): string => TEXTS.allAreLocked(n);

/** Says how many of the selected are locked, where some are. */
export function sayLocked(editor: Editor): void {
  const all = editor.chosenOnes;
  const locked = all.filter((a) => a.locked).length;
  if (!locked) return;
  const some = locked < all.length;
  editor.notices.show({ text: some ? TEXTS.onlyLockedStay(locked) : lockedWords(locked) });
}

/** Those of the selected that may be moved; says so where some of them are locked. */
export function freeOnes(editor: Editor): ReturnType<typeof movable> {
  sayLocked(editor);
  return movable(editor.chosenOnes);
}
