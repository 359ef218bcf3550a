// The cards over the picture, measured from the page: labels keep clear of them, and off the toast where they can.
import type { Rect } from '../../draw/labels';
import type { Stage } from '../../draw/stage';
import type { CardsOver } from '../../edit/overlay/overlay';

/** Classes of the cards. */
const FIXED = ['tr', 'bl', 'br', 'helpbar', 'compass'];
const PASSING = ['toast'];

const isHud = (e: Node | null): boolean => e instanceof Element && e.matches('.hud');

/**
 * Returns the cards in pixels of the picture. They are measured again only after one of them came, went, moved or
 * changed its size: at every frame that would force a layout.
 */
export function measureCards(stage: Stage): () => CardsOver {
  const { element } = stage;
  let known: CardsOver | null = null;
  const forget = (): void => {
    known = null;
    stage.invalidate('overlay');
  };
  // The texts in the cards change in every frame of a drag: only the cards themselves count.
  new MutationObserver((all) => all.some((m) => isHud(m.target) || isHud(m.target.parentNode)) && forget()).observe(
    element,
    { subtree: true, childList: true, attributeFilter: ['class'] },
  );
  const sizes = new ResizeObserver(forget);
  sizes.observe(element);
  // A card slides with the panel beside it.
  addEventListener('transitionend', () => (known = null));
  const watched = new WeakSet<Element>();
  const measure = ({ left, top }: DOMRect): CardsOver => {
    const cards = [...(element.querySelector('.hud')?.children ?? [])];
    const rects = (names: readonly string[]): Rect[] =>
      cards
        .filter((card) => names.some((name) => card.classList.contains(name)))
        .map((card) => {
          if (!watched.has(card)) sizes.observe(card);
          watched.add(card);
          const r = card.getBoundingClientRect();
          return { x: r.left - left, y: r.top - top, w: r.width, h: r.height };
        });
    return { fixed: rects(FIXED), passing: rects(PASSING) };
  };
  return () => (known ??= measure(element.getBoundingClientRect()));
}
