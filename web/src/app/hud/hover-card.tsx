// The road user under the pointer, described beside it.
import { useRef } from 'preact/hooks';
import { useApp } from '../parts/app-context';
import { useLiveEffect } from '../parts/hooks';

/** Width of the card before layout. */
const GUESSED_WIDTH = 220;

export function HoverCard() {
  const { editor, gestures, picture, stage } = useApp();
  const card = useRef<HTMLDivElement>(null);
  const title = useRef<HTMLElement>(null);
  const line = useRef<HTMLSpanElement>(null);
  // Written without rendering: the card's own width decides its position.
  useLiveEffect(() => {
    void [editor.hover.value, editor.drag.info.value, editor.selection.value];
    const el = card.current!;
    const words = picture.hoverWords();
    const p = gestures.pointer;
    el.hidden = !words || !p;
    if (!words || !p) return;
    title.current!.textContent = words.title;
    line.current!.textContent = words.line;
    const { w, h } = stage.view;
    const x = Math.min(w - (el.offsetWidth || GUESSED_WIDTH) - 8, p.x + 14);
    const y = p.y + 70 > h ? p.y - 58 : p.y + 18;
    el.style.transform = `translate(${x}px, ${y}px)`;
  });
  return (
    <div ref={card} class="card tip" aria-hidden="true" hidden>
      <b ref={title} />
      <span ref={line} class="mut" />
    </div>
  );
}
