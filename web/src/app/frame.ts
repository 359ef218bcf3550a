// Layout of the page: panels beside the picture or in a sheet over it, for mouse or fingers.
import type { Opening } from '../actions/context';

/** Width of a sheet at the side. */
const SIDE_SHEET_PX = 352;
/** Width of the loupe on a large and on a small page. */
const LOUPE_PX = 156;
const LOUPE_SMALL_PX = 124;
/** Width of the tool rail for fingers: two columns of large buttons. */
const RAIL_FOR_FINGERS_PX = 132;
/** Scale of handles for fingers. */
const HANDLES_FOR_FINGERS = 1.7;

interface Edges {
  readonly right: number;
  readonly top: number;
  readonly bottom: number;
}

/** The part of the picture beside the sheet. */
export function insetBesideSheet({ form }: Opening, edges: Edges, rail: number): Edges & { left: number } {
  const left = form.small.value ? edges.right : form.touch.value ? RAIL_FOR_FINGERS_PX : rail;
  if (form.low.value) return { ...edges, left, right: SIDE_SHEET_PX, bottom: edges.right };
  // A fully open sheet covers nearly everything; the picture keeps its place.
  return { ...edges, left, bottom: form.pixels(form.height.value === 'peek' ? 'peek' : 'half') + edges.right };
}

/** Attributes of the root element select the layout. */
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
