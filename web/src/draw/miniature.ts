// Small animated pictures of one scene: the map is painted once for all of them, road users in each. They are painted
// on the page itself: some forty stamps each cost less than a message to a worker.
import type { Pen } from './pen';
import { MapPicture } from './paint-map';
import { Recording, Vocabulary } from './recording/recording';
import { paintOn, Player, surface, pen2d, type Canvas2D } from './recording/replay';
import { paletteStamp } from './theme';
import type { View } from './view';

export class Miniatures {
  readonly #words = new Vocabulary();
  readonly #recording = new Recording(this.#words);
  readonly #player = new Player();
  #ground: { readonly canvas: HTMLCanvasElement | OffscreenCanvas; readonly key: string } | null = null;

  /** `g` has the size of the view in its pixels. */
  paint(g: Canvas2D, v: View, map: MapPicture, over: (pen: Pen) => void): void {
    g.setTransform(1, 0, 0, 1, 0, 0);
    g.drawImage(this.#map(v, map), 0, 0);
    g.setTransform(v.dpr, 0, 0, v.dpr, 0, 0);
    over(this.#recording);
    const ops = this.#recording.take();
    this.#player.learn(this.#words.news());
    this.#player.play(g, ops);
  }

  #map(v: View, map: MapPicture): HTMLCanvasElement | OffscreenCanvas {
    const key = `${v.w} ${v.h} ${v.cx} ${v.cy} ${v.z} ${v.turn} ${v.dpr} ${paletteStamp()}`;
    if (this.#ground?.key !== key || this.#of !== map) {
      const canvas = surface(Math.round(v.w * v.dpr), Math.round(v.h * v.dpr));
      paintOn(pen2d(canvas), (pen) => map.paint(pen, v, false));
      this.#ground = { canvas, key };
      this.#of = map;
    }
    return this.#ground.canvas;
  }

  #of: MapPicture | null = null;
}
