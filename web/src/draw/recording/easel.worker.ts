// Runs in a worker: paints the page's recordings, so that the page's thread stays free for input.
import latin from '@fontsource-variable/inter/files/inter-latin-wght-normal.woff2?url';
import latinExt from '@fontsource-variable/inter/files/inter-latin-ext-wght-normal.woff2?url';
import { Easel, type Canvases, type PictureUpdate } from './easel';
import type { FromEasel, ToEasel } from './screen';

/** The used part of a worker's global scope, which the page's types lack. */
interface WorkerScope {
  onmessage: ((e: MessageEvent<ToEasel>) => void) | null;
  postMessage(message: FromEasel): void;
  requestAnimationFrame?(paint: () => void): number;
  readonly fonts: FontFaceSet;
}
const scope = self as unknown as WorkerScope;

let easel: Easel | null = null;
/** Pictures received and not painted yet. */
let waiting = 0;

scope.onmessage = ({ data }) => {
  if ('canvases' in data) start(data.canvases);
  else take(data.picture);
};

function start(canvases: Canvases): void {
  easel = new Easel(canvases);
  // A worker does not have the page's fonts. Their character ranges are those of the style sheet.
  for (const { url, range } of [
    { url: latin, range: undefined },
    { url: latinExt, range: 'U+0100-02BA, U+1E00-1E9F, U+1EF2-1EFF, U+20A0-20AB, U+2C60-2C7F' },
  ]) {
    const face = new FontFace('Inter Variable', `url(${url})`, {
      weight: '100 900',
      ...(range ? { unicodeRange: range } : {}),
    });
    scope.fonts.add(face);
    // The extended one is loaded when a text needs it.
    if (!range) void face.load().then(() => scope.postMessage('fonts'));
  }
}

/** Once for each frame of the screen: of two pictures within one frame the first would be invisible. */
function take(picture: PictureUpdate): void {
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
