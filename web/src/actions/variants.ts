// Variants: ways the scene could go, side by side.
import type { Moment } from '../model/parting';
import { hasScene, inGroup } from './action';
import type { Context } from './context';

const isOpen = (c: Context): boolean => c.variants.open.value;
/** Text about a road user is meant while one is selected and no card has the focus. */
const onCard = (c: Context): boolean => isOpen(c) && c.variants.current.value !== null;
const hasCard = (c: Context): true | string => (onCard(c) ? true : 'Choose a variant first.');
const isComparing = (c: Context): boolean => c.variants.pair.value !== null;

/** A moment nearer to the edge of the picture than this is brought to the middle, pixels. */
const EDGE_PX = 60;

/** To one of the moments at which the two that are compared part. */
export function goToMoment({ editor, stage }: Context, m: Moment): void {
  editor.playhead.pause();
  editor.setTime(m.time);
  const v = stage.view;
  const [x, y] = v.to(...m.at);
  if (x > EDGE_PX + v.inset.left && x < v.w - EDGE_PX && y > EDGE_PX && y < v.h - EDGE_PX) return;
  [v.cx, v.cy] = m.at;
  stage.viewChanged();
}

/** The next one after the playhead, and after the last the first again. */
function nextMoment(c: Context): void {
  const all = c.variants.compared.value?.parting.moments ?? [];
  const next = all.find((m) => m.time > c.editor.time.value + 0.05) ?? all[0];
  if (next) goToMoment(c, next);
}

export const variants = inGroup('Variants', [
  {
    id: 'variants',
    label: 'Variants',
    keys: ['Shift+V'],
    icon: 'variants',
    help: 'Ways the scene could go, side by side on one clock',
    when: hasScene,
    checked: isOpen,
    run: (c) => c.variants.show(!c.variants.open.value),
  },
  {
    id: 'make-variants',
    label: 'Make variants',
    icon: 'variants',
    help: 'New ones from seed and diversity; those that are kept or starred stay',
    when: hasScene,
    run: (c) => void c.variants.make(),
  },
  {
    id: 'keep-variant',
    label: 'Keep variant',
    keys: ['Ctrl+D'],
    icon: 'check',
    help: 'It stays when new ones are made; with none chosen the scene as it is becomes one',
    onOffer: isOpen,
    when: hasScene,
    run: (c) => {
      const id = c.variants.current.value;
      if (id === null) c.variants.keepPresent();
      else c.variants.toggleKept(id);
    },
  },
  {
    id: 'star-variant',
    label: 'Star variant',
    keys: ['S'],
    icon: 'star',
    help: 'Starred ones come first and stay',
    onOffer: onCard,
    when: hasCard,
    run: (c) => c.variants.toggleStar(c.variants.current.value!),
  },
  {
    id: 'name-variant',
    label: 'Name variant',
    keys: ['F2'],
    icon: 'pencil',
    help: 'A name of your own; empty for what differs',
    onOffer: onCard,
    when: hasCard,
    run: (c) => c.variants.startRenaming(c.variants.current.value),
  },
  {
    id: 'remove-variant',
    label: 'Remove variant',
    icon: 'trash',
    help: 'Takes it out of the strip; can be undone',
    when: hasCard,
    run: (c) => c.variants.remove(c.variants.current.value!),
  },
  {
    id: 'compare-variants',
    label: 'Compare variants',
    keys: ['C'],
    icon: 'compare',
    help: 'Press it on two cards: both on one picture, and where they part',
    onOffer: onCard,
    when: hasCard,
    checked: isComparing,
    run: (c) => {
      if (isComparing(c)) c.variants.endCompare();
      else c.variants.compareWith(c.variants.current.value!);
    },
  },
  {
    id: 'export-variants',
    label: 'Export all variants',
    icon: 'export',
    help: 'A file each; those that are kept, or all of them',
    when: (c) => (c.variants.cards.value.length ? true : 'There are no variants.'),
    run: (c) => {
      c.variants.aimExport();
      c.ui.openDialog('export');
    },
  },
  {
    id: 'swap-variants',
    label: 'Swap the two variants',
    keys: ['X'],
    icon: 'swap',
    help: 'The other one comes to the left',
    onOffer: isComparing,
    when: (c) => (isComparing(c) ? true : 'Compare two variants first.'),
    run: (c) => c.variants.swapSides(),
  },
  {
    id: 'next-parting',
    label: 'Next moment at which they part',
    keys: ['E'],
    icon: 'next',
    help: 'From one of the listed moments to the next',
    onOffer: isComparing,
    when: (c) => (isComparing(c) ? true : 'Compare two variants first.'),
    run: nextMoment,
  },
]);
