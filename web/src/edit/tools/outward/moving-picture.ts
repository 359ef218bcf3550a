// The scene as a GIF: the picture ten times a second, for slides and mails that play no film.
import { TEXTS } from '../../../texts/files/export';
import type { Stage } from '../../../draw/stage';
import type { Editor } from '../../session/editor';
import type { FilmFrame } from './gif.worker';

const EVERY_S = 0.1;
const HUNDREDTHS = 10;
/** Wider pictures are scaled down: ten full-size frames a second are too large for a mail. */
const MOST_WIDTH_PX = 800;

/** `progress` gets the share done, from 0 to 1. Null when it was stopped. */
export async function movingPicture(
  editor: Editor,
  stage: Stage,
  progress: (share: number) => void,
  stop: AbortSignal,
): Promise<Blob | null> {
  const { duration } = editor.scene.peek()!;
  const before = editor.playhead.time.peek();
  const worker = new Worker(new URL('./gif.worker.ts', import.meta.url), { type: 'module' });
  try {
    editor.playhead.pause();
    const frames = Math.round(duration / EVERY_S);
    for (let i = 0; i <= frames; i++) {
      if (stop.aborted) return null;
      editor.playhead.moveTo(i * EVERY_S);
      const picture = taken(stage);
      await answer(worker, picture, [picture.rgba.buffer]);
      progress(i / frames);
    }
    return (await answer(worker, null, [])) as Blob | null;
  } finally {
    worker.terminate();
    editor.playhead.moveTo(before);
  }
}

/** The shown picture, in a size fit to send. */
function taken(stage: Stage): FilmFrame {
  const whole = document.createElement('canvas');
  stage.paintOn(whole, ['map', 'agents', 'overlay']);
  const scale = Math.min(1, MOST_WIDTH_PX / whole.width);
  const [width, height] = [Math.round(whole.width * scale), Math.round(whole.height * scale)];
  const small = Object.assign(document.createElement('canvas'), { width, height });
  const g = small.getContext('2d', { alpha: false, willReadFrequently: true })!;
  g.imageSmoothingQuality = 'high';
  g.drawImage(whole, 0, 0, width, height);
  return { rgba: g.getImageData(0, 0, width, height).data, width, height, hundredths: HUNDREDTHS };
}

function answer(worker: Worker, said: FilmFrame | null, give: Transferable[]): Promise<unknown> {
  return new Promise((resolve, reject) => {
    worker.onmessage = (e) => resolve(e.data);
    worker.onerror = () => reject(new Error(TEXTS.notEncoded));
    worker.postMessage(said, give);
  });
}
