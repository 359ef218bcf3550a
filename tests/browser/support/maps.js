// Maps of the example scenes, for journeys that begin without road users, and places on maps being made.

/** The example crossing as a file without road users. */
export async function emptyScene(e) {
  const get = async (path) => (await e.page.request.get(new URL(path, e.page.url()).href)).json();
  const { format, version, meta, time, map, signals } = await get('/v1/scenes/demo-crossing');
  const json = { format, version, name: 'Nobody yet', meta, time, map, signals, agents: [] };
  return { json, bytes: Buffer.from(JSON.stringify(json)) };
}

/** A scene with one unreadable lane. */
export const brokenScene = {
  format: 'dragtraffic.scene',
  version: 1,
  name: 'Two lanes',
  time: { step_s: 0.1, steps: 91, now_step: 0 },
  map: {
    lanes: [
      { id: 'E1', points_m: [[0, 0], [80, 0]], successors: ['E2'] }, // prettier-ignore
      { id: 'E2', points_m: [[80, 0]], predecessors: ['E1'] },
    ],
  },
  agents: [],
};

const heading = ([ax, ay], [bx, by]) => Math.atan2(by - ay, bx - ax);

/** Two adjacent lanes in one direction, with a stretch of both: `{ a, b }` as lists of points. */
export function lanesBeside({ map }) {
  const road = map.lanes.filter((l) => !['bike_lane', 'sidewalk', 'parking'].includes(l.type));
  const length = (p) => p.slice(1).reduce((s, q, i) => s + Math.hypot(q[0] - p[i][0], q[1] - p[i][1]), 0);
  const long = road
    .map((l) => l.points_m)
    .filter((p) => length(p) > 60)
    .sort((p, q) => Math.hypot(...p[0]) - Math.hypot(...q[0]));
  for (const a of long)
    for (const b of long) {
      if (a === b) continue;
      const far = Math.hypot(a[0][0] - b[0][0], a[0][1] - b[0][1]);
      const turn = Math.abs(Math.sin(heading(a[0], a[1]) - heading(b[0], b[1])));
      const same = Math.cos(heading(a[0], a[1]) - heading(b[0], b[1])) > 0.99;
      if (far > 2.5 && far < 4.5 && turn < 0.1 && same) return { a, b };
    }
  throw new Error('no two lanes lie side by side');
}

/** A place this many metres along a line. */
export function along(points, metres) {
  let left = metres;
  for (let i = 1; i < points.length; i++) {
    const [ax, ay] = points[i - 1],
      [bx, by] = points[i];
    const d = Math.hypot(bx - ax, by - ay);
    if (left <= d) return [ax + ((bx - ax) * left) / d, ay + ((by - ay) * left) / d];
    left -= d;
  }
  return points.at(-1).slice(0, 2);
}

/** The box around an area. */
export function boxOf(polygon) {
  const xs = polygon.map((p) => p[0]),
    ys = polygon.map((p) => p[1]);
  return { x0: Math.min(...xs), x1: Math.max(...xs), y0: Math.min(...ys), y1: Math.max(...ys) };
}

/** Distance of a knob beyond the mouth of its arm, metres. */
const KNOB_M = 9;

/** Page position of an arm's knob on a plain crossing, when the arm is at an angle in degrees. */
export async function knobOfArm(e, arm) {
  const reply = await e.page.request.post(new URL('/v1/map', e.page.url()).href, { data: { template: 'four-arms' } });
  const { arms } = await reply.json();
  const out = Math.hypot(...arms[arm].mouth_m) + KNOB_M;
  return (degrees) => e.at(out * Math.cos((degrees * Math.PI) / 180), out * Math.sin((degrees * Math.PI) / 180));
}

/** The example crossing without road users, opened from a file as an own scene. */
export async function openEmpty(e) {
  await e.begin();
  const { json, bytes } = await emptyScene(e);
  await e.drop('nobody.json', bytes);
  await e.until(() => /Nobody yet imported\./.test(document.querySelector('.toast')?.textContent ?? ''));
  await e.settled();
  await e.page.waitForSelector('.nobody');
  return json;
}
