// World to screen: one scale and one offset. y points up in the world and down on the screen.
import { clamp, type Box, type Vec } from '../model/geometry';

const MIN_ZOOM = 0.5;
const MAX_ZOOM = 40;
/** 100 % in the zoom control. */
export const HOME_ZOOM = 8;

export class View {
  cx = 0;
  cy = 0;
  /** Pixels per metre. */
  z = HOME_ZOOM;
  w = 800;
  h = 600;
  dpr = 1;
  /** How large handles are drawn and how far apart they stand: 1, or more for fingers. */
  grip = 1;
  /** Part of the stage that panels cover, so that "fit" means the part one sees. */
  inset = { left: 0, right: 0, top: 0, bottom: 0 };

  x(wx: number): number {
    return this.w / 2 + (wx - this.cx) * this.z;
  }
  y(wy: number): number {
    return this.h / 2 - (wy - this.cy) * this.z;
  }
  to(wx: number, wy: number): [number, number] {
    return [this.x(wx), this.y(wy)];
  }
  from(sx: number, sy: number): Vec {
    return [this.cx + (sx - this.w / 2) / this.z, this.cy - (sy - this.h / 2) / this.z];
  }

  /** The world rectangle on screen, grown by some pixels. */
  box(margin = 0): Box {
    const hx = (this.w / 2 + margin) / this.z,
      hy = (this.h / 2 + margin) / this.z;
    return { x0: this.cx - hx, x1: this.cx + hx, y0: this.cy - hy, y1: this.cy + hy };
  }

  panBy(dx: number, dy: number): void {
    this.cx -= dx / this.z;
    this.cy += dy / this.z;
  }

  /** The same, but not so far that the picture shows more beyond a part of the world than it does; false at its end. */
  panWithin(dx: number, dy: number, b: Box): boolean {
    const { cx, cy } = this;
    this.panBy(dx, dy);
    const { x0, x1, y0, y1 } = this.box();
    // Only the side that comes into view is held, so that nothing jumps where it lies outside already.
    if (dx < 0) this.cx = Math.max(cx, this.cx - Math.max(0, x1 - b.x1));
    else this.cx = Math.min(cx, this.cx + Math.max(0, b.x0 - x0));
    if (dy > 0) this.cy = Math.max(cy, this.cy - Math.max(0, y1 - b.y1));
    else this.cy = Math.min(cy, this.cy + Math.max(0, b.y0 - y0));
    return this.cx !== cx || this.cy !== cy;
  }

  /** Zooms so that the world point under (sx, sy) stays there. */
  zoomAt(sx: number, sy: number, factor: number): void {
    const [wx, wy] = this.from(sx, sy);
    this.z = clamp(this.z * factor, MIN_ZOOM, MAX_ZOOM);
    this.cx = wx - (sx - this.w / 2) / this.z;
    this.cy = wy + (sy - this.h / 2) / this.z;
  }

  fit(b: Box, maxZoom = MAX_ZOOM, minZoom = MIN_ZOOM): void {
    const { left, right, top, bottom } = this.inset;
    const w = Math.max(80, this.w - left - right),
      h = Math.max(80, this.h - top - bottom);
    this.z = clamp(Math.min(w / Math.max(1, b.x1 - b.x0), h / Math.max(1, b.y1 - b.y0)), minZoom, maxZoom);
    this.centre((b.x0 + b.x1) / 2, (b.y0 + b.y1) / 2);
  }

  /** Puts a world point into the middle of the visible part. */
  centre(wx: number, wy: number): void {
    const { left, right, top, bottom } = this.inset;
    this.cx = wx - (left - right) / 2 / this.z;
    this.cy = wy + (top - bottom) / 2 / this.z;
  }

  copy(): View {
    return Object.assign(new View(), this, { inset: { ...this.inset } });
  }
}
