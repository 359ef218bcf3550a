// Playback repeats exactly what the page recorded.
import fc from 'fast-check';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { Easel, type Canvases, type PictureUpdate } from '../../src/draw/recording/easel';
import { Shape, type Pen, type Sprite } from '../../src/draw/pen';
import { Recording, Vocabulary } from '../../src/draw/recording/recording';
import { Player, type Canvas2D } from '../../src/draw/recording/replay';

type Call = [name: string, ...args: unknown[]];

class FakePath {
  readonly calls: Call[] = [];
  moveTo = (...a: number[]) => this.calls.push(['moveTo', ...a]);
  lineTo = (...a: number[]) => this.calls.push(['lineTo', ...a]);
  closePath = () => this.calls.push(['closePath']);
}

/** Records every call and every property assignment. */
function listener(): { g: Canvas2D; calls: Call[] } {
  const calls: Call[] = [];
  const g = new Proxy(
    {},
    {
      get:
        (_, name: string) =>
        (...args: unknown[]) => {
          calls.push([name, ...args.map((a) => (a instanceof FakePath ? a.calls : a))]);
        },
      set: (_, name: string, value) => {
        calls.push([name, value]);
        return true;
      },
    },
  );
  return { g: g as Canvas2D, calls };
}

class FakeCanvas {
  readonly heard = listener();
  constructor(
    public width: number,
    public height: number,
  ) {}
  getContext() {
    return this.heard.g;
  }
}

const real = { Path2D: globalThis.Path2D, OffscreenCanvas: globalThis.OffscreenCanvas };
beforeAll(() => Object.assign(globalThis, { Path2D: FakePath, OffscreenCanvas: FakeCanvas }));
afterAll(() => Object.assign(globalThis, real));

const n = fc.double({ min: -1e7, max: 1e7, noNaN: true });
const text = fc.string({ maxLength: 12 });
const call = (name: string, ...args: fc.Arbitrary<unknown>[]): fc.Arbitrary<Call> =>
  fc.tuple(...args).map((a): Call => [name, ...a]);
const METHODS = fc.oneof(
  ...['beginPath', 'closePath', 'stroke', 'fill', 'save', 'restore'].map((m) => call(m)),
  ...['moveTo', 'lineTo', 'translate'].map((m) => call(m, n, n)),
  call('rotate', n),
  ...['quadraticCurveTo', 'fillRect'].map((m) => call(m, n, n, n, n)),
  call('arc', n, n, n, n, n, fc.boolean()),
  call('ellipse', n, n, n, n, n, n, n),
  call('roundRect', n, n, n, n, n),
  call('setTransform', n, n, n, n, n, n),
  call('fillText', text, n, n),
  call('setLineDash', fc.array(n, { maxLength: 4 })),
);
const PROPERTIES = fc.oneof(
  ...['lineWidth', 'globalAlpha', 'shadowBlur', 'shadowOffsetY'].map((p) => call(p, n)),
  ...['lineCap', 'lineJoin', 'font', 'textAlign', 'textBaseline', 'shadowColor', 'strokeStyle', 'fillStyle'].map((p) =>
    call(p, text),
  ),
);

function draw(pen: Pen, calls: readonly Call[]): void {
  for (const [name, ...args] of calls) {
    const pens = pen as unknown as Record<string, unknown>;
    if (typeof pens[name] === 'function') (pens[name] as (...a: unknown[]) => void).apply(pen, args);
    else pens[name] = args[0];
  }
}

describe('recordings', () => {
  it('are played call for call', () => {
    fc.assert(
      fc.property(fc.array(fc.oneof(METHODS, PROPERTIES), { maxLength: 200 }), (calls) => {
        const words = new Vocabulary();
        const recording = new Recording(words);
        draw(recording, calls);
        const ops = recording.take();
        const player = new Player();
        player.learn(words.news());
        const heard = listener();
        player.play(heard.g, ops);
        expect(heard.calls).toEqual(calls);
      }),
    );
  });

  it('send shapes, sprites and texts once', () => {
    const words = new Vocabulary();
    const recording = new Recording(words);
    const shape = new Shape();
    shape.add(
      [
        [0, 1],
        [2, 3],
      ],
      true,
    );
    shape.add(
      [
        [4, 5],
        [6, 7],
      ],
      false,
    );
    const sprite: Sprite = { key: 'car', width: 9, height: 4, paint: (pen) => pen.fillRect(1, 2, 3, 4) };
    const player = new Player();
    const round = () => {
      recording.fillStyle = 'red';
      recording.strokeShape(shape);
      recording.fillShape(shape, 'evenodd');
      recording.stamp(sprite, 1, 2, 3, 4);
      const ops = recording.take();
      const news = words.news();
      player.learn(news);
      const heard = listener();
      player.play(heard.g, ops);
      return { news, calls: heard.calls };
    };
    const first = round();
    expect([first.news.texts, first.news.shapes.length, first.news.sprites.length]).toEqual([['red'], 1, 1]);
    const path = [['moveTo', 0, 1], ['lineTo', 2, 3], ['closePath'], ['moveTo', 4, 5], ['lineTo', 6, 7]];
    expect(first.calls.slice(0, 3)).toEqual([
      ['fillStyle', 'red'],
      ['stroke', path],
      ['fill', path, 'evenodd'],
    ]);
    const [, stamped, ...where] = first.calls[3] as [string, FakeCanvas, ...number[]];
    expect([stamped.width, stamped.height, stamped.heard.calls, where]).toEqual([
      9,
      4,
      [['fillRect', 1, 2, 3, 4]],
      [1, 2, 3, 4],
    ]);
    const second = round();
    expect([second.news.texts, second.news.shapes, second.news.sprites]).toEqual([[], [], []]);
    expect(second.calls.slice(0, 3)).toEqual(first.calls.slice(0, 3));
  });

  it('start again where the vocabulary is too large', () => {
    const words = new Vocabulary();
    const recording = new Recording(words);
    const player = new Player();
    const say = (from: number) => {
      for (let i = 0; i < 1500; i++) recording.fillText(`text ${from + i}`, 0, 0);
      const ops = recording.take();
      const news = words.news();
      player.learn(news);
      const heard = listener();
      player.play(heard.g, ops);
      return { afresh: news.afresh, last: heard.calls.at(-1)![1] };
    };
    expect([0, 1500, 3000, 4500, 0].map(say)).toEqual([
      { afresh: true, last: 'text 1499' },
      { afresh: false, last: 'text 2999' },
      { afresh: false, last: 'text 4499' },
      { afresh: true, last: 'text 5999' },
      { afresh: false, last: 'text 1499' },
    ]);
  });
});

describe('the easel', () => {
  const IN_PLACE: PictureUpdate['shift'] = { dx: 0, dy: 0, scale: 1, angle: 0 };
  const size = { w: 400, h: 300, dpr: 1 };

  function easel() {
    const picture = new FakeCanvas(1, 1);
    const loupe = new FakeCanvas(1, 1);
    const painter = new Easel({ picture, loupe } as unknown as Canvases);
    const words = new Vocabulary();
    const recording = new Recording(words);
    const write = (text: string) => {
      recording.fillText(text, 0, 0);
      return recording.take();
    };
    /** Layers with a text on each of them, as identification. */
    const take = (texts: Partial<Record<keyof PictureUpdate['layers'], string>>, shift = IN_PLACE) => {
      const layers = Object.fromEntries(Object.entries(texts).map(([name, text]) => [name, write(text)]));
      const news = words.news();
      painter.take({ size, layers, news, shift, loupe: null });
      return news;
    };
    /** The visible content, lowest first: texts, and canvases by the texts on them. */
    const seen = (calls: Call[]): string[] =>
      calls.flatMap(([name, what]) => {
        if (name === 'fillText') return [what as string];
        if (name !== 'drawImage') return [];
        const below = (what as FakeCanvas).heard.calls;
        // Content covered by something as large is invisible.
        return seen(below.slice(below.findLastIndex(([n]) => n === 'drawImage')).filter(Boolean));
      });
    const paint = () => {
      picture.heard.calls.length = 0;
      painter.paint();
      return seen(picture.heard.calls);
    };
    return { take, paint, write, picture };
  }

  it('restores only what the overlay covered', () => {
    const { take, paint, picture } = easel();
    take({ map: 'map', agents: 'cars', overlay: 'flag' });
    paint();
    take({ overlay: 'a flag elsewhere' });
    paint();
    const [[, , x, y, w, h, ...to]] = picture.heard.calls.filter(([name]) => name === 'drawImage') as [
      [string, unknown, ...number[]],
    ];
    // The letters of a font of 10 px at the upper left.
    expect([x, y, to]).toEqual([0, 0, [x, y, w, h]]);
    expect(w).toBeLessThan(100);
    expect(h).toBeLessThan(40);
  });

  it('shows the layers in their order, whichever of them are new', () => {
    const { take, paint } = easel();
    take({ map: 'map', agents: 'cars', overlay: 'flag' });
    expect(paint()).toEqual(['map', 'cars', 'flag']);
    take({ overlay: 'flag 2' });
    expect(paint()).toEqual(['map', 'cars', 'flag 2']);
    take({ agents: 'cars 2' });
    expect(paint()).toEqual(['map', 'cars 2', 'flag 2']);
    take({ overlay: 'flag 3' });
    expect(paint()).toEqual(['map', 'cars 2', 'flag 3']);
    take({}, { ...IN_PLACE, dx: 5 });
    expect(paint()).toEqual(['map', 'cars 2', 'flag 3']);
    expect(paint()).toEqual([]);
  });

  it('paints the newest of pictures that arrive together', () => {
    const { take, paint } = easel();
    take({ map: 'map', agents: 'cars', overlay: 'flag' });
    take({ agents: 'cars 2' });
    take({ overlay: 'flag 2' });
    expect(paint()).toEqual(['map', 'cars 2', 'flag 2']);
  });

  it('still shows older layers when texts are sent again', () => {
    const { take, paint, write } = easel();
    take({ map: 'map', agents: 'cars', overlay: 'flag' });
    for (let i = 0; i < 4500; i++) write(`text ${i}`);
    take({ overlay: 'flag 2' });
    expect(take({ overlay: 'flag 3' }).afresh).toBe(true);
    expect(paint()).toEqual(['map', 'cars', 'flag 3']);
    take({ agents: 'cars 2' });
    expect(paint()).toEqual(['map', 'cars 2', 'flag 3']);
  });
});
