// Runs in a worker: paints what the page has recorded, so that the page's thread is free for the hand.
import latin from '@fontsource-variable/inter/files/inter-latin-wght-normal.woff2?url';
import latinExt from '@fontsource-variable/inter/files/inter-latin-ext-wght-normal.woff2?url';
import { Easel, type Canvases, type Picture } from './easel';
import type { FromEasel, ToEasel } from './screen';

/** The part of a worker's global scope that is used here; the page's types do not know it. */
interface Scope {
  onmessage: ((e: MessageEvent<ToEasel>) => void) | null;
  postMessage(message: FromEasel): void;
  requestAnimationFrame?(paint: () => void): number;
  readonly fonts: FontFaceSet;
}
const scope = self as unknown as Scope;

let easel: Easel | null = null;
/** Pictures taken and not painted yet. */
let waiting = 0;

scope.onmessage = ({ data }) => {
  if ('canvases' in data) start(data.canvases);
  else take(data.picture);
};

function start(canvases: Canvases): void {
  easel = new Easel(canvases);
  // A worker does not see the page's fonts. Their ranges of characters are those of the style sheet.
  for (const { url, range } of [
    { url: latin, range: undefined },
    { url: latinExt, range: 'U+0100-02BA, U+1E00-1E9F, U+1EF2-1EFF, U+20A0-20AB, U+2C60-2C7F' },
  ]) {
    const face = new FontFace('Inter Variable', `url(${url})`, {
      weight: '100 900',
      ...(range ? { unicodeRange: range } : {}),
    });
    scope.fonts.add(face);
    // The extended one comes when a text needs it.
    if (!range) void face.load().then(() => scope.postMessage('fonts'));
  }
}

/** Once for each frame of the screen: of two pictures in one of them nobody would see the first. */
function take(picture: Picture): void {
  easel?.take(picture);
  if (waiting++) return;
  if (scope.requestAnimationFrame) scope.requestAnimationFrame(paint);
  else paint();
}

function paint(): void {
  easel?.paint();
  scope.postMessage({ shown: waiting });
  waiting = 0;
}
