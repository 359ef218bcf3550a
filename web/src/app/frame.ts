// How the page is laid out: beside the picture or in a sheet over it, for a mouse or for fingers.
import type { Opening } from '../actions/context';

/** How wide a sheet at the side is. */
const SIDE_SHEET_PX = 352;
/** How wide the loupe is, where there is room and where there is little. */
const LOUPE_PX = 156;
const LOUPE_SMALL_PX = 124;
/** The rail of tools, whose buttons stand in two columns where fingers need them large. */
const RAIL_FOR_FINGERS_PX = 132;
/** Handles for fingers are so much larger. */
const HANDLES_FOR_FINGERS = 1.7;

interface Edges {
  readonly right: number;
  readonly top: number;
  readonly bottom: number;
}

/** What the sheet leaves of the picture. */
export function insetBesideSheet({ form }: Opening, edges: Edges, rail: number): Edges & { left: number } {
  const left = form.small.value ? edges.right : form.touch.value ? RAIL_FOR_FINGERS_PX : rail;
  if (form.low.value) return { ...edges, left, right: SIDE_SHEET_PX, bottom: edges.right };
  // A sheet that is fully open covers nearly everything; the picture stays where it was.
  return { ...edges, left, bottom: form.pixels(form.height.value === 'peek' ? 'peek' : 'half') + edges.right };
}

/** The page is laid out by attributes of its root. */
export function followForm({ form, stage, ui }: Opening): void {
  const root = document.documentElement.dataset;
  root.form = form.sheet.value ? (form.low.value ? 'side-sheet' : 'sheet') : 'panels';
  for (const [name, on] of [
    ['touch', form.touch.value],
    ['small', form.small.value],
    ['tall', ui.tall.value],
  ] as const)
    if (on) root[name] = '';
    else delete root[name];
  stage.view.grip = form.touch.value ? HANDLES_FOR_FINGERS : 1;
  stage.loupePx = form.small.value ? LOUPE_SMALL_PX : LOUPE_PX;
  document.documentElement.style.setProperty('--loupe', `${stage.loupePx}px`);
  stage.invalidate('overlay');
}
