// Place: tools that put road users into the scene, and filling it.
import type { PlacedKind } from '../model/base/kinds';
import { TOOLS } from '../edit/gestures/tools';
import { placeGhost } from '../edit/gestures/placing';
import { hasScene, inGroup } from './action';
import type { Context } from './context';
import { TEXTS } from '../texts/desk/actions';

const tools = TOOLS.flatMap((t) => ('places' in t ? [t] : [])).map(({ name, label, key, icon, help }) => ({
  id: `tool-${name}`,
  label,
  keys: [key],
  icon,
  help,
  when: hasScene,
  checked: (c: Context) => c.editor.tool.value === name,
  run: (c: Context) => startPlacing(c, name),
}));

/** The ghost appears at once: under the pointer, else in the middle of the picture. */
function startPlacing(c: Context, name: (typeof TOOLS)[number]['name']): void {
  const { editor, gestures, stage, ui } = c;
  editor.playhead.pause();
  editor.setTime(0);
  editor.chooseTool(name);
  ui.showDrawer(null);
  const kind = TOOLS.find((t) => t.name === name);
  const { view } = stage;
  const { left, right, top, bottom } = view.inset;
  const at = gestures.pointer ?? { x: (left + view.w - right) / 2, y: (top + view.h - bottom) / 2 };
  if (kind && 'places' in kind)
    editor.placement.pointAt(editor.scene.peek()!, kind.places, view.from(at.x, at.y), view.z, false);
}

/** The kind that the tool in hand places; null for other tools. */
export function placedBy({ editor }: Context): PlacedKind | null {
  const tool = TOOLS.find((t) => t.name === editor.tool.value);
  return tool && 'places' in tool ? tool.places : null;
}

const isFilling = (c: Context): boolean => c.editor.filling.wish.value !== null;

function addOrClose({ editor, filler }: Context): void {
  const { filling, notices } = editor;
  if (!filling.drawn.peek()) filler.add();
  else if (!filling.closeOutline()) notices.show({ text: TEXTS.anAreaNeedsThree });
}

const isEmpty = (c: Context): boolean => c.editor.resting.value?.agents.size === 0;

export const place = inGroup('place', [
  ...tools,
  {
    id: 'place-here',
    label: TEXTS.placeHere,
    keys: ['Enter'],
    icon: 'check',
    help: 'putsTheRoad',
    onOffer: (c) => placedBy(c) !== null && c.editor.placement.ghosts.value !== null,
    when: (c) => (c.editor.placement.ghosts.value ? true : TEXTS.chooseWhatTo),
    run: (c) => placeGhost(c.editor),
  },
  {
    id: 'place-first',
    label: TEXTS.placeACar,
    keys: ['C'],
    icon: 'car',
    help: 'clickALane',
    onOffer: isEmpty,
    when: hasScene,
    run: (c) => startPlacing(c, 'place-car'),
  },
  {
    id: 'fill-add',
    label: TEXTS.addWhatIsPreviewed,
    keys: ['Enter'],
    icon: 'check',
    help: 'theRoadUsers',
    onOffer: isFilling,
    when: (c) =>
      !isFilling(c)
        ? TEXTS.fillAnAreaFirst
        : c.editor.filling.drawn.value || c.editor.filling.all.value.length
          ? true
          : TEXTS.nobodyIsInThe,
    run: (c) => addOrClose(c),
  },
  {
    id: 'fill-shuffle',
    label: TEXTS.shuffleThePreview,
    keys: ['R'],
    icon: 'dice',
    help: 'anotherSeed',
    onOffer: isFilling,
    when: (c) => (isFilling(c) ? true : TEXTS.fillAnAreaFirst),
    run: (c) => c.editor.filling.shuffle(),
  },
]);
