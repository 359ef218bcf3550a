// Variants: alternatives of the scene, side by side.
import type { DivergingMoment } from '../model/words/comparison';
import { hasScene, inGroup } from './action';
import type { Context } from './context';
import { TEXTS } from '../texts/desk/actions';

const isOpen = (c: Context): boolean => c.variants.open.value;
/** Text keys go to the road user while one is selected and no card has the focus. */
const onCard = (c: Context): boolean => isOpen(c) && c.variants.current.value !== null;
const hasCard = (c: Context): true | string => (onCard(c) ? true : TEXTS.selectAVariantFirst);
const isComparing = (c: Context): boolean => c.variants.comparing.pair.value !== null;

/** A moment nearer to the edge of the picture than this is centred, pixels. */
const EDGE_PX = 60;

/** Goes to a moment when the two compared variants diverge. */
export function goToMoment({ editor, stage }: Context, m: DivergingMoment): void {
  editor.playhead.pause();
  editor.playhead.moveTo(m.time);
  const v = stage.view;
  const [x, y] = v.to(...m.at);
  if (x > EDGE_PX + v.inset.left && x < v.w - EDGE_PX && y > EDGE_PX && y < v.h - EDGE_PX) return;
  [v.cx, v.cy] = m.at;
  stage.viewChanged();
}

/** The next one after the playhead; after the last, the first again. */
function nextMoment(c: Context): void {
  const all = c.variants.comparing.compared.value?.comparison.moments ?? [];
  const next = all.find((m) => m.time > c.editor.playhead.time.value + 0.05) ?? all[0];
  if (next) goToMoment(c, next);
}

export const variants = inGroup('variants', [
  {
    id: 'variants',
    label: TEXTS.variants,
    keys: ['Shift+V'],
    icon: 'variants',
    help: 'alternativeFutures',
    when: hasScene,
    checked: isOpen,
    run: (c) => c.variants.show(!c.variants.open.value),
  },
  {
    id: 'make-variants',
    label: TEXTS.makeVariants,
    icon: 'variants',
    help: 'newOnesFrom',
    when: hasScene,
    run: (c) => void c.variants.make(),
  },
  {
    id: 'keep-variant',
    label: TEXTS.keepVariant,
    keys: ['Ctrl+D'],
    icon: 'check',
    help: 'keepsTheVariant',
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
    label: TEXTS.starVariant,
    keys: ['S'],
    icon: 'star',
    help: 'starredComeFirst',
    onOffer: onCard,
    when: hasCard,
    run: (c) => c.variants.toggleStar(c.variants.current.value!),
  },
  {
    id: 'name-variant',
    label: TEXTS.nameVariant,
    keys: ['F2'],
    icon: 'pencil',
    help: 'aNameOfYour',
    onOffer: onCard,
    when: hasCard,
    run: (c) => c.variants.startRenaming(c.variants.current.value),
  },
  {
    id: 'remove-variant',
    label: TEXTS.removeVariant,
    icon: 'trash',
    help: 'removesItFromTheStrip',
    when: hasCard,
    run: (c) => c.variants.remove(c.variants.current.value!),
  },
  {
    id: 'compare-variants',
    label: TEXTS.compareVariants,
    keys: ['C'],
    icon: 'compare',
    help: 'pressItOnTwo',
    onOffer: onCard,
    when: hasCard,
    checked: isComparing,
    run: (c) => {
      if (isComparing(c)) c.variants.comparing.end();
      else c.variants.comparing.with(c.variants.current.value!);
    },
  },
  {
    id: 'export-variants',
    label: TEXTS.exportAllVariants,
    icon: 'export',
    help: 'aFileEachThose',
    when: (c) => (c.variants.cards.value.length ? true : TEXTS.noVariantsYet),
    run: (c) => {
      c.variants.aimExport();
      c.ui.openDialog('export');
    },
  },
  {
    id: 'swap-variants',
    label: TEXTS.swapTheTwoVariants,
    keys: ['X'],
    icon: 'swap',
    help: 'movesTheRightToTheLeft',
    onOffer: isComparing,
    when: (c) => (isComparing(c) ? true : TEXTS.compareTwoVariants),
    run: (c) => c.variants.comparing.swapSides(),
  },
  {
    id: 'next-difference',
    label: TEXTS.nextDifference,
    keys: ['E'],
    icon: 'next',
    help: 'goesThroughTheDifferences',
    onOffer: isComparing,
    when: (c) => (isComparing(c) ? true : TEXTS.compareTwoVariants),
    run: nextMoment,
  },
]);
