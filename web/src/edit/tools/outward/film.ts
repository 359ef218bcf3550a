// A film of the scene as shown, from 0 s to the end, in real time.
import type { Stage } from '../../../draw/stage';
import type { Editor } from '../../session/editor';

const FRAMES_PER_S = 30;
const BITS_PER_S = 8_000_000;
/** Formats that browsers can write, best first. */
const KINDS = ['video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/webm', 'video/mp4'];

/** The film format of this browser; null where it has none. */
export const filmKind = (): string | null =>
  typeof MediaRecorder === 'undefined' ? null : (KINDS.find((k) => MediaRecorder.isTypeSupported(k)) ?? null);

export const filmEnding = (kind: string): string => (kind.includes('mp4') ? 'mp4' : 'webm');

/** `progress` gets the share done, from 0 to 1. Null when it was stopped. */
export async function film(
  editor: Editor,
  stage: Stage,
  kind: string,
  progress: (share: number) => void,
  stop: AbortSignal,
): Promise<Blob | null> {
  const { duration } = editor.scene.peek()!;
  const before = editor.playhead.time.peek();
  editor.playhead.pause();
  editor.playhead.moveTo(0);
  const map = document.createElement('canvas');
  stage.paintOn(map, ['map']);
  const { width, height } = map;
  const canvas = Object.assign(document.createElement('canvas'), { width, height });
  const g = canvas.getContext('2d', { alpha: false })!;
  const recorder = new MediaRecorder(canvas.captureStream(FRAMES_PER_S), {
    mimeType: kind,
    videoBitsPerSecond: BITS_PER_S,
  });
  const parts: Blob[] = [];
  recorder.ondataavailable = (e) => parts.push(e.data);
  const ended = new Promise<void>((resolve) => (recorder.onstop = () => resolve()));
  recorder.start();
  const began = performance.now();
  for (let t = 0; t < duration && !stop.aborted; t = (performance.now() - began) / 1000) {
    editor.playhead.moveTo(Math.min(duration, t));
    await frame();
    g.setTransform(1, 0, 0, 1, 0, 0);
    g.drawImage(map, 0, 0);
    stage.paintOn(canvas, ['agents', 'overlay']);
    progress(Math.min(1, t / duration));
  }
  recorder.stop();
  await ended;
  editor.playhead.moveTo(before);
  return stop.aborted ? null : new Blob(parts, { type: kind.split(';')[0] });
}

const frame = (): Promise<unknown> => new Promise(requestAnimationFrame);
