// On a small page inspector and timeline are one sheet over the picture, with three heights. The grip is dragged,
// flicked or tapped.
import { useRef } from 'preact/hooks';
import { useComputed, useSignal } from '@preact/signals';
import type { Context } from '../../actions/context';
import type { SheetHeight } from '../../actions/form';
import { Inspector } from '../inspector/inspector';
import { useApp } from '../parts/app-context';
import { IconButton } from '../parts/buttons';
import { useLiveEffect } from '../parts/hooks';
import { Icon } from '../parts/icons';
import { Timeline } from '../timeline/timeline';
import { TEXTS } from '../../texts/desk/page';

const WORDS: Record<SheetHeight, string> = { peek: TEXTS.nearlyClosed, half: TEXTS.halfOpen, full: TEXTS.fullyOpen };
/** A grip that moved less was tapped, pixels. */
const TAP_PX = 6;
/** A flick is faster than this, pixels a millisecond. */
const FLICK = 0.45;

export function Sheet() {
  const c = useApp();
  const { editor, form, rounds, ui, variants } = c;
  /** Pixels while the grip is in hand. */
  const inHand = useSignal<number | null>(null);
  const px = useComputed(() => {
    const wanted = inHand.value ?? form.pixels(form.height.value);
    return editor.dragging.value ? Math.min(wanted, form.whileDragging) : wanted;
  });
  const opened = useRef<string | null>(null);
  /** Is a list over the picture that has no room beside an open sheet? */
  const list = useComputed(() => form.crowded && editor.isOpen.value && ui.drawer.value !== null);
  const instead = useComputed(() => variants.open.value || rounds.isOpen.value || list.value);
  // Who is selected has fields to show, unless something else has their room.
  useLiveEffect(() => {
    const id = editor.selection.value;
    if (!instead.peek() && id !== null && id !== opened.current) form.offer();
    opened.current = id;
  });
  // So have events that are asked for.
  useLiveEffect(() => {
    if (ui.eventsPanel.value && !instead.peek()) form.offer();
  });
  // Strip and open sheet together would leave nothing of the picture.
  useLiveEffect(() => {
    if (instead.value) form.open('peek');
  });
  useLiveEffect(() => {
    if (form.height.value !== 'peek' && list.peek()) ui.showDrawer(null);
  });
  // What floats over the picture stands above the sheet; a sheet that covers everything leaves it where it was.
  useLiveEffect(() => {
    const px = form.pixels(form.height.value === 'peek' ? 'peek' : 'half');
    document.documentElement.style.setProperty('--sheet', `${px}px`);
  });
  const grip = useGrip(c, inHand);
  const label = useComputed(() => TEXTS.panel(WORDS[form.height.value]));
  return (
    <section
      class="sheet"
      aria-label={TEXTS.panelTitle}
      data-height={form.height}
      data-held={useComputed(() => (inHand.value === null ? null : ''))}
      style={useComputed(() => `height: ${px.value}px`)}
      onClick={(e) => {
        const at = e.target as Element;
        // Hardly open it is its title, and a tap on that says: show me more. What is pressed in it does what it does.
        if (form.height.peek() === 'peek' && at.closest('.ih') && !at.closest('button')) form.pull('half');
      }}
    >
      <button type="button" class="grip" aria-label={label} {...grip} />
      <div class="peekplay">
        <IconButton id="play" class="playing" after={<Icon name="pause" size={18} />} />
      </div>
      <Inspector />
      <Timeline />
    </section>
  );
}

/** The sheet follows the hand; let go, it goes to the nearest height, or the next one where it was flicked. */
function useGrip({ form }: Context, inHand: { value: number | null }) {
  const from = useRef<{ y: number; px: number; far: number } | null>(null);
  const last = useRef({ y: 0, at: 0, speed: 0 });
  /** With a mouse a click follows the release; one that ended a drag is none. */
  const moved = useRef(false);
  const start = (e: PointerEvent & { currentTarget: HTMLElement }) => {
    moved.current = false;
    from.current = { y: e.clientY, px: form.pixels(form.height.peek()), far: 0 };
    last.current = { y: e.clientY, at: e.timeStamp, speed: 0 };
    e.currentTarget.setPointerCapture(e.pointerId);
  };
  const move = (e: PointerEvent) => {
    const f = from.current;
    if (!f) return;
    const up = f.y - e.clientY;
    f.far = Math.max(f.far, Math.abs(up));
    if (f.far < TAP_PX) return;
    const { y, at } = last.current;
    if (e.timeStamp > at) last.current = { y: e.clientY, at: e.timeStamp, speed: (y - e.clientY) / (e.timeStamp - at) };
    inHand.value = Math.max(form.pixels('peek'), Math.min(form.pixels('full'), f.px + up));
  };
  const end = (e: PointerEvent) => {
    const f = from.current;
    from.current = null;
    const px = inHand.value;
    inHand.value = null;
    if (!f || px === null) return;
    const speed = e.timeStamp - last.current.at < 80 ? last.current.speed : 0;
    const near = form.nearest(px);
    if (Math.abs(speed) < FLICK || near !== form.height.peek()) form.pull(near);
    else if (speed > 0 && near !== 'full') form.step(1);
    else if (speed < 0 && near !== 'peek') form.step(-1);
    moved.current = true;
  };
  return {
    onPointerDown: start,
    onPointerMove: move,
    onPointerUp: end,
    onPointerCancel: end,
    onClick: () => {
      if (moved.current) moved.current = false;
      else form.step(1);
    },
    onKeyDown: (e: KeyboardEvent) => {
      if (e.key !== 'ArrowUp' && e.key !== 'ArrowDown') return;
      e.preventDefault();
      e.stopPropagation();
      const down = e.key === 'ArrowDown';
      if (form.height.peek() !== (down ? 'peek' : 'full')) form.step(down ? -1 : 1);
    },
  };
}
