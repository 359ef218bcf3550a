// What a picture says of itself where no editor is around it: how long a metre is, when it is, and where north is.
import { seconds } from '../model/base/units';
import { textWidth } from './labels';
import type { Pen } from './pen';
import { scaleOf } from './scale';
import { colours, font } from './theme';
import type { View } from './view';
import { TEXTS } from '../texts/scene/places';

const [EDGE, HEIGHT, PAD, GAP, ARROW] = [12, 30, 12, 10, 16];

/** Paints it into the lower left corner, in pixels of the view. */
export function paintLegend(g: Pen, v: View, time: number): void {
  const c = colours();
  const scale = scaleOf(v);
  const words = [scale.words, seconds(time)];
  const face = font(600, 12);
  const bar = scale.px;
  const wide = bar + words.reduce((sum, w) => sum + GAP + textWidth(face, w), 0) + GAP + ARROW;
  const middle = v.h - EDGE - HEIGHT / 2;
  let x = EDGE + PAD;
  g.save();
  g.beginPath();
  g.roundRect(EDGE, middle - HEIGHT / 2, wide + 2 * PAD, HEIGHT, 8);
  g.fillStyle = c.surface;
  g.fill();
  g.beginPath();
  g.moveTo(x, middle - 4);
  g.lineTo(x, middle + 4);
  g.lineTo(x + bar, middle + 4);
  g.lineTo(x + bar, middle - 4);
  g.strokeStyle = c.ink;
  g.lineWidth = 1.5;
  g.stroke();
  g.fillStyle = c.ink;
  g.font = face;
  g.textBaseline = 'middle';
  g.textAlign = 'left';
  x += bar;
  for (const w of words) {
    g.fillText(w, x + GAP, middle + 0.5);
    x += GAP + textWidth(face, w);
  }
  paintNorth(g, x + GAP + ARROW / 2, middle, v.turn);
  g.restore();
}

/** An arrow to the north with its letter, about its middle. */
function paintNorth(g: Pen, x: number, y: number, turn: number): void {
  g.save();
  g.translate(x, y);
  // The picture is turned counter-clockwise, and pixels count downwards.
  g.rotate(-turn);
  g.beginPath();
  g.moveTo(0, -11);
  g.lineTo(4.5, -3);
  g.lineTo(-4.5, -3);
  g.closePath();
  g.fill();
  g.font = font(700, 10);
  g.textAlign = 'center';
  g.fillText(TEXTS.n, 0, 4.5);
  g.restore();
}
