// Small marks beside road users: the pennant at a goal, the lock of a locked one.
import type { Pen } from './pen';
import { roundRect } from './sprites';
import type { Vec } from '../model/base/geometry';
import { colours, type ColourName } from './theme';
import type { View } from './view';

/** Screen position of a pennant, and its road user. */
export interface Pennant {
  readonly id: string;
  readonly x: number;
  readonly y: number;
}

const HEIGHT = 20;
const WIDTH = 13;

export const onPennant = (p: Pennant, x: number, y: number): boolean =>
  x > p.x - 6 && x < p.x + WIDTH + 4 && y > p.y - HEIGHT - 4 && y < p.y + 6;

/** A flag with its foot on the goal, in the colour of its owner. */
export function paintPennant(g: Pen, { x, y }: Pennant, colour: ColourName): void {
  const c = colours();
  const top = y - HEIGHT;
  const cloth = (): void => {
    g.beginPath();
    g.moveTo(x, top);
    g.lineTo(x + WIDTH, top + 4.5);
    g.lineTo(x, top + 9);
    g.closePath();
  };
  const pole = (): void => {
    g.beginPath();
    g.moveTo(x, y);
    g.lineTo(x, top);
  };
  g.lineCap = g.lineJoin = 'round';
  g.strokeStyle = c.halo;
  g.lineWidth = 4.2;
  pole();
  g.stroke();
  cloth();
  g.lineWidth = 3;
  g.stroke();
  g.fillStyle = c.goal;
  g.fill();
  g.strokeStyle = c.goal;
  g.lineWidth = 1.6;
  pole();
  g.stroke();
  g.beginPath();
  g.arc(x, y, 2.6, 0, Math.PI * 2);
  g.fillStyle = c[colour];
  g.strokeStyle = c.halo;
  g.lineWidth = 1.4;
  g.fill();
  g.stroke();
}

/** A small lock on a disc. */
export function paintLock(g: Pen, x: number, y: number): void {
  const c = colours();
  g.beginPath();
  g.arc(x, y, 7, 0, Math.PI * 2);
  g.fillStyle = c.surface;
  g.fill();
  g.strokeStyle = c['line-strong'];
  g.lineWidth = 1;
  g.stroke();
  g.fillStyle = g.strokeStyle = c.ink;
  roundRect(g, x - 3, y - 0.8, 6, 4.4, 1);
  g.fill();
  g.lineWidth = 1.2;
  g.beginPath();
  g.arc(x, y - 1, 2, Math.PI, 0);
  g.stroke();
}

/** Least radius of a ring, so that it can be grabbed apart from the diamond in it, in pixels. */
export const ringRadius = (v: View, metres: number): number => Math.max(metres * v.z, 16 * v.grip);

/** A via point: a diamond, and the dashed ring of its tolerance around it. */
export function viaRing(
  g: Pen,
  [x, y]: Vec,
  radius: number,
  look: { colour: string; hollow: boolean; inHand: boolean; k: number },
): void {
  const c = colours();
  const ring = (width: number, colour: string, dash: number[]): void => {
    g.beginPath();
    g.arc(x, y, radius, 0, Math.PI * 2);
    g.strokeStyle = colour;
    g.lineWidth = width;
    g.setLineDash(dash);
    g.stroke();
    g.setLineDash([]);
  };
  ring(look.inHand ? 5 : 4, c.halo, []);
  ring(look.inHand ? 2.4 : 1.6, look.colour, [4, 3.5]);
  const r = 7.5 * look.k;
  g.beginPath();
  g.moveTo(x, y - r);
  g.lineTo(x + r, y);
  g.lineTo(x, y + r);
  g.lineTo(x - r, y);
  g.closePath();
  g.lineJoin = 'round';
  g.strokeStyle = c.halo;
  g.lineWidth = 5;
  g.stroke();
  g.fillStyle = look.hollow ? c.surface : look.colour;
  g.fill();
  g.strokeStyle = look.colour;
  g.lineWidth = 2;
  g.stroke();
}
