// The painters' drawings as SVG.
import { describe, expect, it } from 'vitest';
import { Shape } from '../../src/draw/pen';
import { SvgPen } from '../../src/draw/svg-pen';

describe('a pen for SVG', () => {
  it('writes lines and areas like a canvas', () => {
    const pen = new SvgPen();
    pen.setTransform(2, 0, 0, -2, 100, 50);
    pen.strokeStyle = '#123';
    pen.lineWidth = 3;
    pen.setLineDash([1, 2]);
    pen.beginPath();
    pen.moveTo(0, 0);
    pen.lineTo(10, 5);
    pen.stroke();
    expect(pen.take()).toContain('d="M100 50L120 40"');
    expect(pen.take()).toContain('stroke="#123" stroke-width="6"');
    expect(pen.take()).toContain('stroke-dasharray="2 4"');
  });

  it('saves and restores its state, and turns', () => {
    const pen = new SvgPen();
    pen.save();
    pen.translate(10, 0);
    pen.rotate(Math.PI / 2);
    pen.fillStyle = 'red';
    pen.fillRect(0, 0, 4, 2);
    pen.restore();
    pen.fillRect(0, 0, 1, 1);
    expect(pen.take()).toContain('<path d="M10 0L10 4L8 4L8 0Z" fill="red"/>');
    expect(pen.take()).toContain('<path d="M0 0L1 0L1 1L0 1Z" fill="#000"/>');
  });

  it('draws shapes with holes, and repeated stamps once', () => {
    const pen = new SvgPen();
    const shape = new Shape();
    const square = (a: number, b: number) => [[a, a], [b, a], [b, b]] as const; // prettier-ignore
    shape.add(square(0, 9), true);
    shape.add(square(2, 4), true);
    pen.fillShape(shape, 'evenodd');
    const sprite = {
      key: 'car',
      width: 10,
      height: 4,
      paint: (p: { fillRect: SvgPen['fillRect'] }) => p.fillRect(0, 0, 10, 4),
    };
    pen.stamp(sprite, 5, 5, 20, 8);
    pen.stamp(sprite, 50, 5, 20, 8);
    const file = pen.file(100, 50, 'A & B', '2 px a metre');
    expect(file).toContain('d="M0 0L9 0L9 9ZM2 2L4 2L4 4Z" fill="#000" fill-rule="evenodd"');
    expect(file.match(/<use href="#d1"/g)).toHaveLength(2);
    expect(file.match(/<g id="d1">/g)).toHaveLength(1);
    expect(file).toContain('<title>A &amp; B</title>');
  });

  it('escapes texts', () => {
    const pen = new SvgPen();
    pen.font = '600 11px "Inter Variable", system-ui';
    pen.textAlign = 'center';
    pen.fillText('<b> & "c"', 3, 4);
    expect(pen.take()).toContain('text-anchor="middle" font-weight="600" font-size="11px"');
    expect(pen.take()).toContain('&lt;b&gt; &amp; &quot;c&quot;</text>');
  });
});
