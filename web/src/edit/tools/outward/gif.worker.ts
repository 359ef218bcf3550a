// Compresses the pictures of a film, off the main thread.
import { GifWriter, paletteOf } from './gif';

/** A picture; `null` ends the film. */
export interface FilmFrame {
  readonly rgba: Uint8ClampedArray;
  readonly width: number;
  readonly height: number;
  readonly hundredths: number;
}

let writer: GifWriter | null = null;

onmessage = ({ data }: MessageEvent<FilmFrame | null>) => {
  if (!data) {
    postMessage(writer?.end() ?? null);
    return;
  }
  const { rgba, width, height, hundredths } = data;
  writer ??= new GifWriter(width, height, paletteOf(rgba));
  writer.add(rgba, hundredths);
  // Ready for the next one.
  postMessage(true);
};
