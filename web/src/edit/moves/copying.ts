// Copy, cut, paste, duplicate. Copies are text, so that they can be pasted into another tab's scene.
import type { Vec } from '../../model/base/geometry';
import { copiesText, readCopies, shifted, type Newcomer } from '../../model/document/newcomer';
import { wrapAngle } from '../../model/base/geometry';
import type { Editor } from '../session/editor';
import { addThem, copiesOf, movable, removeThem, tooMany, whoWords, withRoom } from './several';
import { snapNewcomer } from './placing';
import { TEXTS } from '../../texts/editing/moves';

export class Copying {
  /** The last copy made here, for pages without clipboard access. */
  #last: string | null = null;

  constructor(private readonly editor: Editor) {}

  get last(): string | null {
    return this.#last;
  }

  /** The selected road users as text; null where none can be copied. */
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

  /** Pastes the road users of a text, centred at a place; false where the text has none. */
  paste(text: string, at: Vec | null, zoom: number): boolean {
    const { editor } = this;
    const scene = editor.scene.peek();
    const copies = readCopies(text);
    if (!copies || !scene) return false;
    const full = tooMany(scene, copies.length);
    if (full) editor.notices.show({ text: full });
    else editor.commits.run(addThem(scene, withRoom(scene, at ? this.#around(copies, at, zoom) : copies), 'pasted'));
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
    else editor.commits.run(addThem(scene, withRoom(scene, copies), 'duplicated'));
  }
}

/** Removes the selected road users; locked ones stay. */
export function removeSelected(editor: Editor): void {
  const scene = editor.scene.peek();
  const all = editor.chosenOnes;
  const free = all.filter((a) => !a.locked);
  if (!scene || !all.length) return;
  const stay = all.length - free.length;
  if (!free.length) editor.notices.show({ text: lockedWords(stay) });
  else {
    const command = removeThem(scene, free);
    editor.commits.run(command);
    editor.notices.show({
      text: `${command.name}.${stay ? TEXTS.lockedUnchanged(stay) : ''}`,
      undo: true,
    });
    editor.notices.say(`${command.name}.`);
  }
}

/** Notice where all selected road users are locked. */
export const lockedWords = (n: number): string => TEXTS.allAreLocked(n);

/** Notifies how many of the selected are locked, if any. */
export function sayLocked(editor: Editor): void {
  const all = editor.chosenOnes;
  const locked = all.filter((a) => a.locked).length;
  if (!locked) return;
  const some = locked < all.length;
  editor.notices.show({ text: some ? TEXTS.onlyLocked(locked) : lockedWords(locked) });
}

/** The selected road users that may be moved; notifies where some are locked. */
export function freeOnes(editor: Editor): ReturnType<typeof movable> {
  sayLocked(editor);
  return movable(editor.chosenOnes);
}
