// The visible scene: a canvas painted by a worker, or by the page where a browser has no canvas for workers.
import { CANVASES, Easel, type Canvases, type CanvasLayer, type PictureUpdate, type Size, type Shift } from './easel';
import { Recording, Vocabulary } from './recording';

export type ToEasel = { canvases: Canvases } | { picture: PictureUpdate };
/** Number of pictures on the canvases; or a notice that fonts have changed. */
export type FromEasel = { shown: number } | 'fonts';

/** Pictures that may be under way: the worker paints the newest of them once a frame. */
const AHEAD = 4;

export class Screen {
  #words = new Vocabulary();
  #recording = new Recording(this.#words);
  #worker: Worker | null = null;
  #easel: Easel | null = null;
  #onWay = 0;
  #canvases: HTMLCanvasElement[] = [];

  /** `onFree`: the next picture may be sent; `onLost`: everything must be painted again. */
  constructor(
    private readonly element: HTMLElement,
    private readonly onFree: () => void,
    private readonly onLost: () => void,
  ) {
    const canvases = this.#hang();
    const canHandOver = typeof Worker !== 'undefined' && 'transferControlToOffscreen' in canvases.picture;
    if (canHandOver) this.#employ(canvases);
    else this.#easel = new Easel(canvases);
  }

  /** The limit of pictures under way is reached. */
  get busy(): boolean {
    return this.#onWay >= AHEAD;
  }

  /** Records what `paint` draws. */
  record(paint: (pen: Recording) => void): Float64Array {
    paint(this.#recording);
    return this.#recording.take();
  }

  show(
    size: Size,
    layers: Partial<Record<CanvasLayer, Float64Array>>,
    shift: Shift,
    loupe: PictureUpdate['loupe'] = null,
  ): void {
    const picture: PictureUpdate = { size, layers, shift, loupe, news: this.#words.news() };
    if (this.#easel) {
      this.#easel.take(picture);
      this.#easel.paint();
      return;
    }
    this.#onWay++;
    const moved = [
      ...Object.values(layers).map((ops) => ops.buffer),
      ...picture.news.shapes.flatMap((s) => [s.points.buffer, s.ends.buffer]),
      ...picture.news.sprites.map((s) => s.ops.buffer),
    ] as ArrayBuffer[];
    this.#worker!.postMessage({ picture } satisfies ToEasel, moved);
  }

  close(): void {
    this.#worker?.terminate();
    for (const c of this.#canvases) c.remove();
  }

  /** Replaces the canvases with new ones. */
  #hang(): Record<keyof Canvases, HTMLCanvasElement> {
    for (const c of this.#canvases) c.remove();
    const made = CANVASES.map((name) => {
      const c = document.createElement('canvas');
      c.className = name;
      c.setAttribute('aria-hidden', 'true');
      return [name, c] as const;
    });
    this.#canvases = made.map(([, c]) => c);
    this.element.prepend(...this.#canvases);
    return Object.fromEntries(made) as Record<keyof Canvases, HTMLCanvasElement>;
  }

  #employ(canvases: Record<keyof Canvases, HTMLCanvasElement>): void {
    const worker = new Worker(new URL('./easel.worker.ts', import.meta.url), { type: 'module' });
    this.#worker = worker;
    worker.onmessage = ({ data }: MessageEvent<FromEasel>) => {
      if (data === 'fonts') return this.onLost();
      this.#onWay -= data.shown;
      this.onFree();
    };
    // Transferred canvases do not come back: the page paints on new ones.
    worker.onerror = () => {
      worker.terminate();
      this.#worker = null;
      this.#onWay = 0;
      this.#words = new Vocabulary();
      this.#recording = new Recording(this.#words);
      this.#easel = new Easel(this.#hang());
      this.onLost();
    };
    const off = CANVASES.map((name) => [name, canvases[name].transferControlToOffscreen()] as const);
    const handed = Object.fromEntries(off) as Record<keyof Canvases, OffscreenCanvas>;
    worker.postMessage({ canvases: handed } satisfies ToEasel, Object.values(handed));
  }
}
