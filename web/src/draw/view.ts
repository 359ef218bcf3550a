// World to screen and back: one scale, one turn and one offset, known only here. y points up in the world and down on
// the screen.
import {
  boxOf,
  clamp,
  wrapAngle,
  type Box,
  type OnLine,
  type Point,
  type Quad,
  type Vec,
} from '../model/base/geometry';
import type { Camera } from '../model/document/history';
import type { Pen } from './pen';

const MIN_ZOOM = 0.5;
const MAX_ZOOM = 40;
/** 100 % in the zoom control. */
export const HOME_ZOOM = 8;
/** A turn by less than this is zero, and a quarter turn is exact to it, radians. */
const EXACT_RAD = 1e-9;

export class View {
  cx = 0;
  cy = 0;
  /** Pixels per metre. */
  z = HOME_ZOOM;
  w = 800;
  h = 600;
  dpr = 1;
  /** Scale of handles and their distances: 1, or more for fingers. */
  grip = 1;
  /** Part of the stage covered by panels, so that "fit" uses the visible part. */
  inset = { left: 0, right: 0, top: 0, bottom: 0 };
  private turned = 0;
  private cos = 1;
  private sin = 0;

  /** Turn of the picture, counter-clockwise, radians: at 0 north is up. */
  get turn(): number {
    return this.turned;
  }
  set turn(angle: number) {
    const t = wrapAngle(angle);
    const quarters = Math.round(t / (Math.PI / 2));
    const exact = Math.abs(t - (quarters * Math.PI) / 2) < EXACT_RAD;
    this.turned = exact && !quarters ? 0 : t;
    // Both or none, or the matrix would not be a rotation.
    this.cos = exact ? [1, 0, -1, 0][(quarters + 4) % 4] : Math.cos(t);
    this.sin = exact ? [0, 1, 0, -1][(quarters + 4) % 4] : Math.sin(t);
  }

  x(wx: number, wy: number): number {
    return this.w / 2 + ((wx - this.cx) * this.cos - (wy - this.cy) * this.sin) * this.z;
  }
  y(wx: number, wy: number): number {
    return this.h / 2 - ((wx - this.cx) * this.sin + (wy - this.cy) * this.cos) * this.z;
  }
  to(wx: number, wy: number): [number, number] {
    return [this.x(wx, wy), this.y(wx, wy)];
  }
  from(sx: number, sy: number): Vec {
    const [dx, dy] = this.way(sx - this.w / 2, sy - this.h / 2);
    return [this.cx + dx, this.cy + dy];
  }

  /** Moves the picture, so that a screen position shows a world point. */
  put([sx, sy]: Vec, [wx, wy]: Vec): void {
    const [x, y] = this.from(sx, sy);
    this.cx += wx - x;
    this.cy += wy - y;
  }

  /** Distance of a world point from a screen position, pixels. */
  away([wx, wy]: Vec, { x, y }: Point): number {
    return Math.hypot(this.x(wx, wy) - x, this.y(wx, wy) - y);
  }

  /** Converts pixels right and down to metres of the world. */
  way(right: number, down: number): Vec {
    return this.along(right / this.z, -down / this.z);
  }
  /** Converts metres right and up on the screen to metres of the world. */
  along(right: number, up: number): Vec {
    return [right * this.cos + up * this.sin, up * this.cos - right * this.sin];
  }
  /** Converts metres of the world to metres right and up on the screen. */
  across(dx: number, dy: number): Vec {
    return [dx * this.cos - dy * this.sin, dy * this.cos + dx * this.sin];
  }

  /** Screen direction of a heading: a unit vector, right and down. */
  ahead(heading: number): Vec {
    const angle = heading + this.turned;
    return [Math.cos(angle), -Math.sin(angle)];
  }
  /** The same as a screen angle, which is clockwise. */
  angle(heading: number): number {
    return -(heading + this.turned);
  }

  /** Moves the pen's origin to a pose: forward is to the right. */
  stand(g: Pen, p: OnLine): void {
    g.translate(...this.to(p.x, p.y));
    g.rotate(this.angle(p.heading));
  }
  /** Makes the pen draw in metres of the world. */
  lay(g: Pen): void {
    const k = this.dpr * this.z;
    const [c, s] = [k * this.cos, k * this.sin];
    g.setTransform(c, -s, -s, -c, this.dpr * this.x(0, 0), this.dpr * this.y(0, 0));
  }

  /** The upright world rectangle around the visible part, grown by some pixels. */
  box(margin = 0): Box {
    const hx = (this.w / 2 + margin) / this.z,
      hy = (this.h / 2 + margin) / this.z;
    const [c, s] = [Math.abs(this.cos), Math.abs(this.sin)];
    const x = hx * c + hy * s,
      y = hx * s + hy * c;
    return { x0: this.cx - x, x1: this.cx + x, y0: this.cy - y, y1: this.cy + y };
  }
  /** The upright screen rectangle around a world rectangle, pixels. */
  around(b: Box): Box {
    return boxOf(corners(b).map(([x, y]) => this.to(x, y)));
  }
  /**
   * The rectangle that is upright on the screen, with two world points as corners: its world corners, counter-clockwise
   * from the lower left.
   */
  frame(a: Vec, b: Vec): Quad {
    const [right, up] = this.across(b[0] - a[0], b[1] - a[1]);
    const from = (r: number, u: number): Vec => {
      const [dx, dy] = this.along(r, u);
      return [a[0] + dx, a[1] + dy];
    };
    const [r0, r1] = [Math.min(0, right), Math.max(0, right)];
    const [u0, u1] = [Math.min(0, up), Math.max(0, up)];
    return [from(r0, u0), from(r1, u0), from(r1, u1), from(r0, u1)];
  }
  /** Is a world point on screen, or at most this many pixels outside? */
  shows(wx: number, wy: number, margin = 0): boolean {
    const x = this.x(wx, wy),
      y = this.y(wx, wy);
    return x > -margin && x < this.w + margin && y > -margin && y < this.h + margin;
  }

  /** Is a world point in the uncovered part, this many pixels away from its edge? */
  isClear(wx: number, wy: number, edge = 0): boolean {
    const { left, right, top, bottom } = this.inset;
    const x = this.x(wx, wy),
      y = this.y(wx, wy);
    return x > left + edge && x < this.w - right - edge && y > top + edge && y < this.h - bottom - edge;
  }

  /** Where the line between two screen positions leaves the uncovered part, this many pixels from its edge. */
  exit([ax, ay]: Vec, [bx, by]: Vec, edge: number): Vec {
    const { left, right, top, bottom } = this.inset;
    const within = (from: number, to: number, least: number, most: number): number =>
      to > most ? (most - from) / (to - from) : to < least ? (least - from) / (to - from) : 1;
    const k = Math.max(
      0,
      Math.min(within(ax, bx, left + edge, this.w - right - edge), within(ay, by, top + edge, this.h - bottom - edge)),
    );
    return [ax + (bx - ax) * k, ay + (by - ay) * k];
  }

  panBy(dx: number, dy: number): void {
    const [x, y] = this.way(dx, dy);
    this.cx -= x;
    this.cy -= y;
  }

  /** The same, limited so that the picture shows no more beyond a part of the world than now; false at its end. */
  panWithin(dx: number, dy: number, b: Box): boolean {
    const { x0, x1, y0, y1 } = this.around(b);
    // Only the side that comes into view is limited, so that a picture already outside does not jump.
    const held = (by: number, from: number, to: number, size: number): number =>
      by < 0 ? Math.max(by, Math.min(0, size - to)) : Math.min(by, Math.max(0, -from));
    const x = held(dx, x0, x1, this.w),
      y = held(dy, y0, y1, this.h);
    this.panBy(x, y);
    return x !== 0 || y !== 0;
  }

  /**
   * Moves just far enough to bring a screen rectangle into the uncovered part, this many pixels from its edge; false,
   * without a move, for one that is too large.
   */
  panInto(b: Box, edge = 0): boolean {
    const { left, right, top, bottom } = this.inset;
    const wide = this.w - left - right - 2 * edge,
      high = this.h - top - bottom - 2 * edge;
    if (b.x1 - b.x0 > wide || b.y1 - b.y0 > high) return false;
    const by = (from: number, to: number, start: number, size: number): number =>
      from < start ? start - from : Math.min(0, start + size - to);
    this.panBy(by(b.x0, b.x1, left + edge, wide), by(b.y0, b.y1, top + edge, high));
    return true;
  }

  /** Zooms so that the world point under (sx, sy) stays there. */
  zoomAt(sx: number, sy: number, factor: number): void {
    this.#about(sx, sy, () => (this.z = clamp(this.z * factor, MIN_ZOOM, MAX_ZOOM)));
  }
  /** Turns so that the world point under (sx, sy) stays there. */
  turnAt(sx: number, sy: number, turn: number): void {
    this.#about(sx, sy, () => (this.turn = turn));
  }
  /** Turns about the middle of the visible part. */
  turnTo(turn: number): void {
    const { left, right, top, bottom } = this.inset;
    this.turnAt((this.w + left - right) / 2, (this.h + top - bottom) / 2, turn);
  }
  #about(sx: number, sy: number, change: () => void): void {
    const [wx, wy] = this.from(sx, sy);
    change();
    const [dx, dy] = this.way(sx - this.w / 2, sy - this.h / 2);
    this.cx = wx - dx;
    this.cy = wy - dy;
  }

  fit(b: Box, maxZoom = MAX_ZOOM, minZoom = MIN_ZOOM): void {
    this.fitPlaces(corners(b), 0, maxZoom, minZoom);
  }
  /** Fits places, and this many metres around them, into the visible part. */
  fitPlaces(places: readonly Vec[], around: number, maxZoom = MAX_ZOOM, minZoom = MIN_ZOOM): void {
    const { left, right, top, bottom } = this.inset;
    const w = Math.max(80, this.w - left - right),
      h = Math.max(80, this.h - top - bottom);
    const { x0, x1, y0, y1 } = boxOf(places.map(([x, y]) => this.across(x, y)));
    const wide = Math.max(1, x1 - x0 + 2 * around),
      high = Math.max(1, y1 - y0 + 2 * around);
    this.z = clamp(Math.min(w / wide, h / high), minZoom, maxZoom);
    this.centre(...this.along((x0 + x1) / 2, (y0 + y1) / 2));
  }

  /** Centres a world point in the visible part. */
  centre(wx: number, wy: number): void {
    const { left, right, top, bottom } = this.inset;
    const [dx, dy] = this.way((left - right) / 2, (top - bottom) / 2);
    this.cx = wx - dx;
    this.cy = wy - dy;
  }

  get camera(): Required<Camera> {
    const { cx, cy, z, turn } = this;
    return { cx, cy, z, turn };
  }
  /** Sets the camera; without a turn north is up. */
  look({ cx, cy, z, turn = 0 }: Camera): void {
    Object.assign(this, { cx, cy, z, turn });
  }

  copy(): View {
    return Object.assign(new View(), this, { inset: { ...this.inset } });
  }
}

const corners = ({ x0, x1, y0, y1 }: Box): readonly Vec[] => [
  [x0, y0],
  [x1, y0],
  [x1, y1],
  [x0, y1],
];
