// Map geometry as Path2D pieces of about 64 m: a repaint strokes a few dozen paths instead of thousands.
import { boxesMeet, emptyBox, growBox, type Box, type Vec } from '../model/geometry';

interface Tile {
  readonly path: Path2D;
  readonly box: Box;
}

const SIZE = 64;

export class Layer {
  private readonly tiles = new Map<string, Tile>();

  constructor(readonly reach = 6) {}

  get empty(): boolean {
    return this.tiles.size === 0;
  }

  add(pts: readonly Vec[], closed = false): void {
    if (pts.length < 2) return;
    const mid = pts[pts.length >> 1];
    const tile = this.tile(`${Math.floor(mid[0] / SIZE)},${Math.floor(mid[1] / SIZE)}`);
    pts.forEach((p, i) => {
      if (i) tile.path.lineTo(p[0], p[1]);
      else tile.path.moveTo(p[0], p[1]);
      growBox(tile.box, p[0], p[1]);
    });
    if (closed) tile.path.closePath();
  }

  stroke(g: CanvasRenderingContext2D, view: Box): void {
    for (const t of this.visible(view)) g.stroke(t.path);
  }
  fill(g: CanvasRenderingContext2D, view: Box, rule: CanvasFillRule = 'nonzero'): void {
    for (const t of this.visible(view)) g.fill(t.path, rule);
  }

  private *visible(view: Box): Generator<Tile> {
    const r = this.reach;
    const grown = { x0: view.x0 - r, y0: view.y0 - r, x1: view.x1 + r, y1: view.y1 + r };
    for (const t of this.tiles.values()) if (boxesMeet(t.box, grown)) yield t;
  }

  private tile(key: string): Tile {
    let t = this.tiles.get(key);
    if (!t) this.tiles.set(key, (t = { path: new Path2D(), box: emptyBox() }));
    return t;
  }
}
