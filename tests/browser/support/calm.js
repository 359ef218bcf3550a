// How much a page shows at once: controls in sight, and labels over the road.
import { pixelsOf } from './pixels.js';

/** Controls that a user sees: in the window, visible, and not under something else. */
export const controlsInSight = (page) =>
  page.evaluate(() => {
    const all = document.querySelectorAll('button, input, select, textarea, a[href], [role="slider"]');
    return [...all]
      .filter((e) => {
        const r = e.getBoundingClientRect();
        const [x, y] = [r.left + r.width / 2, r.top + r.height / 2];
        const { visibility, opacity } = getComputedStyle(e);
        // Controls for screen readers have no size.
        if (r.width < 4 || r.height < 4 || visibility === 'hidden' || opacity === '0') return false;
        if (x < 0 || y < 0 || x >= innerWidth || y >= innerHeight) return false;
        const top = document.elementFromPoint(x, y);
        return e.contains(top) || !!e.closest('label')?.contains(top);
      })
      .map((e) => e.dataset.action ?? e.getAttribute('aria-label') ?? e.textContent);
  });

/**
 * Width and height: higher than a path with its halo, lower than a label, in pixels of the page. For fingers it is
 * wider than a handle, and leaves out the letters, too.
 */
const LABEL_PX = [13, 13];
export const LABEL_BESIDE_HANDLES_PX = [30, 13];

/**
 * Share of the road's pixels under labels: pixels with the colours of a road in the picture before, and changed after,
 * in a changed rectangle of `least`. It leaves out paths, which are narrower. Both pictures show the same part
 * of the map.
 */
export const underLabels = async (page, before, after, least = LABEL_PX) =>
  page.evaluate(
    ([p, q, least]) => {
      const { width: w, height: h } = p;
      const [wide, high] = least.map((px) => Math.round(px * devicePixelRatio));
      const style = getComputedStyle(document.documentElement);
      const road = ['--map-asphalt', '--map-crosswalk', '--map-bike'].map((name) => {
        const hex = style.getPropertyValue(name).trim();
        return [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
      });
      const off = (d, i, [r, g, b]) => Math.abs(d[i] - r) + Math.abs(d[i + 1] - g) + Math.abs(d[i + 2] - b);
      const changed = (i) => off(q.data, 4 * i, [p.data[4 * i], p.data[4 * i + 1], p.data[4 * i + 2]]) > 24;
      // Changed pixels above and to the left of each pixel.
      const sum = new Uint32Array((w + 1) * (h + 1));
      for (let y = 0; y < h; y++)
        for (let x = 0; x < w; x++)
          sum[(y + 1) * (w + 1) + x + 1] =
            Number(changed(y * w + x)) + sum[y * (w + 1) + x + 1] + sum[(y + 1) * (w + 1) + x] - sum[y * (w + 1) + x];
      const changedFrom = (x, y) =>
        sum[(y + high) * (w + 1) + x + wide] -
        sum[y * (w + 1) + x + wide] -
        sum[(y + high) * (w + 1) + x] +
        sum[y * (w + 1) + x];
      const label = new Uint8Array(w * h);
      for (let y = 0; y + high <= h; y++)
        for (let x = 0; x + wide <= w; x++)
          if (changedFrom(x, y) === wide * high)
            for (let k = y; k < y + high; k++) label.fill(1, k * w + x, k * w + x + wide);
      let [all, under] = [0, 0];
      for (let i = 0; i < w * h; i++) {
        if (!road.some((colour) => off(p.data, 4 * i, colour) < 8)) continue;
        all++;
        under += label[i];
      }
      return { all, share: under / all };
    },
    [await pixelsOf(page, before), await pixelsOf(page, after), least],
  );
