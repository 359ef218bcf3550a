// Constructed answers for tests: six smooth paths to a goal, rough at first and final after the last step.

const N = 90;
const wave = (i, a, seed) => Math.sin(i * 0.37 + seed * 1.7) * a + Math.sin(i * 0.11 + seed) * a * 0.6;

export function sixFutures(agent, condition, step, steps) {
  const t = agent.track;
  const k = t.x_m.findIndex((_, i) => i === 0);
  const s = condition?.start ?? {},
    g = condition?.goal ?? {};
  const x0 = s.x_m ?? t.x_m[k],
    y0 = s.y_m ?? t.y_m[k],
    h0 = s.heading_rad ?? t.heading_rad[k];
  const v0 = s.speed_mps ?? Math.hypot(t.vx_mps[k], t.vy_mps[k]);
  const end = t.x_m.length - 1;
  const gx = g.x_m ?? t.x_m[end],
    gy = g.y_m ?? t.y_m[end],
    gh = g.heading_rad ?? t.heading_rad[end];
  const T = g.time_s ?? 9;
  const d = Math.hypot(gx - x0, gy - y0) * 0.42;
  const rough = 1.4 * (1 - step / steps) ** 1.5;
  const probabilities = [0.41, 0.22, 0.14, 0.11, 0.08, 0.04];
  const fixed = g.x_m !== undefined;
  return probabilities.map((probability, m) => {
    const bulge = fixed ? [0, 0.25, -0.25, 1.2, -1.2, 0.5][m] : [0, 0.4, -0.4, 3, -3, 1][m];
    const reach = fixed ? (m === 5 ? 0.6 : 1) : [1, 0.75, 0.45, 1.1, 0.9, 0.2][m];
    const pace = [0, 0.25, -0.2, 0.05, 0, 0.4][m];
    const at = (u) => {
      const q = Math.max(0, Math.min(1, u)),
        w = 1 - q;
      const c1 = [x0 + Math.cos(h0) * d, y0 + Math.sin(h0) * d],
        c2 = [gx - Math.cos(gh) * d, gy - Math.sin(gh) * d];
      const side = Math.sin(Math.PI * q) * bulge;
      return [
        w ** 3 * x0 + 3 * w * w * q * c1[0] + 3 * w * q * q * c2[0] + q ** 3 * gx - Math.sin(h0) * side,
        w ** 3 * y0 + 3 * w * w * q * c1[1] + 3 * w * q * q * c2[1] + q ** 3 * gy + Math.cos(h0) * side,
      ];
    };
    const mode = { probability, first_step: 1, x_m: [], y_m: [], heading_rad: [], vx_mps: [], vy_mps: [] };
    let px = x0,
      py = y0,
      ph = h0;
    for (let i = 1; i <= N; i++) {
      const lin = Math.min(1.15, i / (T * 10));
      const u = (lin - pace * Math.sin(Math.PI * Math.min(1, lin)) * 0.25 * (v0 > 0.2 ? 1 : 0)) * reach;
      let [x, y] = at(u);
      const fade = Math.sin(Math.PI * Math.min(1, i / N));
      x += wave(i, rough * fade, m + 1);
      y += wave(i + 9, rough * fade, m + 2);
      const moved = Math.hypot(x - px, y - py);
      const h = moved > 0.02 ? Math.atan2(y - py, x - px) : ph;
      mode.x_m.push(Math.round(x * 1000) / 1000);
      mode.y_m.push(Math.round(y * 1000) / 1000);
      mode.heading_rad.push(Math.round(h * 1e4) / 1e4);
      mode.vx_mps.push(Math.round((x - px) * 10000) / 1000);
      mode.vy_mps.push(Math.round((y - py) * 10000) / 1000);
      px = x;
      py = y;
      ph = h;
    }
    return mode;
  });
}

/** A road user near the path of the changed one waits a little. */
export function giveWay(agent, seconds) {
  const t = agent.track,
    n = t.x_m.length;
  const mode = { probability: 1, first_step: 1, x_m: [], y_m: [], heading_rad: [], vx_mps: [], vy_mps: [] };
  const lag = Math.round(seconds * 10);
  for (let i = 1; i < n; i++) {
    const src = Math.max(0, i - Math.min(lag, Math.round((i / n) * lag * 1.6)));
    mode.x_m.push(t.x_m[src]);
    mode.y_m.push(t.y_m[src]);
    mode.heading_rad.push(t.heading_rad[src]);
    const prev = Math.max(0, i - 1 - Math.min(lag, Math.round(((i - 1) / n) * lag * 1.6)));
    mode.vx_mps.push((t.x_m[src] - t.x_m[prev]) * 10);
    mode.vy_mps.push((t.y_m[src] - t.y_m[prev]) * 10);
  }
  return mode;
}

/** The reaction of a road user that gives way: its cause, and where it is slowest. */
export function reactionTo(cause, mode, delay_s) {
  const speed = (i) => Math.hypot(mode.vx_mps[i], mode.vy_mps[i]);
  let low = 5;
  for (let i = 5; i < mode.x_m.length - 10; i++) if (speed(i) < speed(low) - 0.01) low = i;
  return {
    kind: speed(low) < 0.6 ? 'waits' : 'slows',
    cause,
    delay_s,
    time_s: (low + mode.first_step) / 10,
    x_m: mode.x_m[low],
    y_m: mode.y_m[low],
    speed_mps: speed(low),
  };
}

/** Extends a future with its last motion. */
export function goOn(mode, steps) {
  const end = mode.x_m.length - 1;
  const last = Object.fromEntries(['x_m', 'y_m', 'heading_rad', 'vx_mps', 'vy_mps'].map((k) => [k, mode[k][end]]));
  for (let i = 1; mode.x_m.length < steps; i++) {
    mode.x_m.push(last.x_m + last.vx_mps * 0.1 * i);
    mode.y_m.push(last.y_m + last.vy_mps * 0.1 * i);
    mode.heading_rad.push(last.heading_rad);
    mode.vx_mps.push(last.vx_mps);
    mode.vy_mps.push(last.vy_mps);
  }
}
