// Map geometry in tiles of about 64 m: a repaint strokes a few dozen paths instead of thousands.
import { boxesMeet, emptyBox, growBox, type Box, type Vec } from '../model/base/geometry';
import { Shape, type Pen } from './pen';

interface Tile {
  readonly shape: Shape;
  readonly box: Box;
}

const SIZE = 64;

export class TileLayer {
  private readonly tiles = new Map<string, Tile>();

  constructor(readonly reach = 6) {}

  get empty(): boolean {
    return this.tiles.size === 0;
  }

  /** `along`: the line whose tile it shares, as a hole with its area. */
  add(pts: readonly Vec[], closed = false, along: readonly Vec[] = pts): void {
    if (pts.length < 2) return;
    const mid = along[along.length >> 1];
    const tile = this.tile(`${Math.floor(mid[0] / SIZE)},${Math.floor(mid[1] / SIZE)}`);
    tile.shape.add(pts, closed);
    for (const [x, y] of pts) growBox(tile.box, x, y);
  }

  stroke(g: Pen, view: Box): void {
    for (const t of this.visible(view)) g.strokeShape(t.shape);
  }
  fill(g: Pen, view: Box, rule: CanvasFillRule = 'nonzero'): void {
    for (const t of this.visible(view)) g.fillShape(t.shape, rule);
  }

  private *visible(view: Box): Generator<Tile> {
    const r = this.reach;
    const grown = { x0: view.x0 - r, y0: view.y0 - r, x1: view.x1 + r, y1: view.y1 + r };
    for (const t of this.tiles.values()) if (boxesMeet(t.box, grown)) yield t;
  }

  private tile(key: string): Tile {
    let t = this.tiles.get(key);
    if (!t) this.tiles.set(key, (t = { shape: new Shape(), box: emptyBox() }));
    return t;
  }
}
