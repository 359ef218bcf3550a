// Fingers, by the protocol of the browser: the page gets the events of a phone.
import { devices } from './devices.js';

export { devices };

export class Fingers {
  constructor(editor) {
    this.e = editor;
  }

  #send(type, points) {
    return this.e.cdp.send('Input.dispatchTouchEvent', {
      type,
      touchPoints: points.map(([x, y], id) => ({ x, y, id, radiusX: 8, radiusY: 8 })),
    });
  }

  async tap(...points) {
    await this.#send('touchStart', points.slice(0, 1));
    for (let n = 2; n <= points.length; n++) await this.#send('touchStart', points.slice(0, n));
    await this.#send('touchEnd', []);
    await this.e.frames(2);
  }

  async down(...points) {
    await this.#send('touchStart', points);
    await this.e.frames(1);
  }

  async move(...points) {
    await this.#send('touchMove', points);
    await this.e.frames(1);
  }

  async up() {
    await this.#send('touchEnd', []);
    await this.e.frames(2);
  }

  /** From one place to another; the finger stays down. */
  async drag(from, to, steps = 10) {
    await this.down(from);
    for (let i = 1; i <= steps; i++)
      await this.move([from[0] + ((to[0] - from[0]) * i) / steps, from[1] + ((to[1] - from[1]) * i) / steps]);
  }
}
