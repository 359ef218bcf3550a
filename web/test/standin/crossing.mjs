// Builds a small signalised crossing for tests: lanes with successors, bike lanes, crosswalks, signals, and road users
// that follow them. Not shipped.

const STEPS = 91;
const ARMS = [0, 90, 180, 270].map((d) => (d * Math.PI) / 180);
const STOP = 16,
  FAR = 110;

const at = (arm, along, left) => [
  along * Math.cos(arm) - left * Math.sin(arm),
  along * Math.sin(arm) + left * Math.cos(arm),
];
const r3 = (v) => Math.round(v * 1000) / 1000 || 0;
const pt = (p) => [r3(p[0]), r3(p[1])];

function straight(a, b, n) {
  return Array.from({ length: n + 1 }, (_, i) => pt([a[0] + ((b[0] - a[0]) * i) / n, a[1] + ((b[1] - a[1]) * i) / n]));
}

function bend(p, h, q, g) {
  const d = Math.hypot(q[0] - p[0], q[1] - p[1]) * 0.42;
  const c1 = [p[0] + Math.cos(h) * d, p[1] + Math.sin(h) * d],
    c2 = [q[0] - Math.cos(g) * d, q[1] - Math.sin(g) * d];
  return Array.from({ length: 17 }, (_, i) => {
    const t = i / 16,
      u = 1 - t;
    return pt([0, 1].map((k) => u ** 3 * p[k] + 3 * u * u * t * c1[k] + 3 * u * t * t * c2[k] + t ** 3 * q[k]));
  });
}

const IN = [1.75, 5.1],
  OUT = [-1.75, -5.1],
  BIKE = 7.8,
  EDGE = 8.8;

function lanes() {
  const out = [];
  const lane = (id, type, points, extra = {}) =>
    out.push({
      id,
      type,
      points_m: points,
      width_m: type === 'bike_lane' ? 1.8 : 3.3,
      left_boundary: [],
      right_boundary: [],
      speed_limit_mps: 13.9,
      predecessors: [],
      successors: [],
      left_neighbors: [],
      right_neighbors: [],
      interpolating: false,
      ...extra,
    });
  ARMS.forEach((a, i) => {
    IN.forEach((v, k) => lane(`in${i}${k}`, 'surface_street', straight(at(a, FAR, v), at(a, STOP, v), 12)));
    OUT.forEach((v, k) => lane(`out${i}${k}`, 'surface_street', straight(at(a, STOP - 3, v), at(a, FAR, v), 12)));
    lane(`bin${i}`, 'bike_lane', straight(at(a, FAR, BIKE), at(a, STOP, BIKE), 12));
    lane(`bout${i}`, 'bike_lane', straight(at(a, STOP - 3, -BIKE), at(a, FAR, -BIKE), 12));
  });
  const join = (from, to, i, j, v, w, bike) => {
    const id = `x_${from}_${to}`;
    const p = at(ARMS[i], STOP, v),
      q = at(ARMS[j], STOP - 3, w);
    lane(id, bike ? 'bike_lane' : 'surface_street', bend(p, ARMS[i] + Math.PI, q, ARMS[j]), {
      predecessors: [from],
      successors: [to],
      interpolating: true,
    });
    out.find((l) => l.id === from).successors.push(id);
    out.find((l) => l.id === to).predecessors.push(id);
  };
  for (let i = 0; i < 4; i++) {
    const opposite = (i + 2) % 4,
      left = (i + 3) % 4,
      right = (i + 1) % 4;
    join(`in${i}0`, `out${left}0`, i, left, IN[0], OUT[0]);
    join(`in${i}0`, `out${opposite}0`, i, opposite, IN[0], OUT[0]);
    join(`in${i}1`, `out${opposite}1`, i, opposite, IN[1], OUT[1]);
    join(`in${i}1`, `out${right}1`, i, right, IN[1], OUT[1]);
    join(`bin${i}`, `bout${opposite}`, i, opposite, BIKE, -BIKE, true);
  }
  return out;
}

function markings() {
  const lines = [],
    edges = [],
    crosswalks = [];
  ARMS.forEach((a, i) => {
    const line = (type, v, u0, u1) =>
      lines.push({ id: `l${lines.length}`, type, points_m: [pt(at(a, u0, v)), pt(at(a, u1, v))] });
    line('solid_double_yellow', 0, STOP, FAR);
    line('broken_single_white', 3.42, STOP + 20, FAR);
    line('solid_single_white', 3.42, STOP, STOP + 20);
    line('broken_single_white', -3.42, STOP, FAR);
    line('solid_single_white', 6.85, STOP, FAR);
    line('solid_single_white', -6.85, STOP - 3, FAR);
    const b = ARMS[(i + 1) % 4];
    edges.push({
      id: `e${i}`,
      type: 'boundary',
      points_m: [
        pt(at(a, FAR, EDGE)),
        ...bend(at(a, 14, EDGE), a + Math.PI, at(b, 14, -EDGE), b),
        pt(at(b, FAR, -EDGE)),
      ],
    });
    crosswalks.push({
      id: `c${i}`,
      polygon_m: [
        [11, -EDGE],
        [14.2, -EDGE],
        [14.2, EDGE],
        [11, EDGE],
      ].map(([u, v]) => pt(at(a, u, v))),
    });
  });
  // Far out, between the two directions of one arm.
  edges.push({ id: 'm0', type: 'median', points_m: [pt(at(ARMS[1], 70, 0)), pt(at(ARMS[1], FAR, 0))] });
  return { lines, edges, crosswalks };
}

/** A track along points at a changing speed. */
function drive(points, v0, v1, stopAt = Infinity) {
  const s = [0];
  for (let i = 1; i < points.length; i++)
    s.push(s[i - 1] + Math.hypot(points[i][0] - points[i - 1][0], points[i][1] - points[i - 1][1]));
  const t = {
    first_step: 0,
    valid: [[0, STEPS]],
    x_m: [],
    y_m: [],
    z_m: null,
    heading_rad: [],
    vx_mps: [],
    vy_mps: [],
  };
  let d = 0;
  for (let i = 0; i < STEPS; i++) {
    let v = v0 + ((v1 - v0) * i) / (STEPS - 1);
    if (stopAt < Infinity) v = Math.min(v, Math.sqrt(Math.max(0, 2 * 3 * (stopAt - d))));
    let k = 1;
    while (k < points.length - 1 && s[k] < d) k++;
    const a = points[k - 1],
      b = points[k],
      f = Math.min(1, (d - s[k - 1]) / Math.max(1e-6, s[k] - s[k - 1]));
    const h = Math.atan2(b[1] - a[1], b[0] - a[0]);
    t.x_m.push(r3(a[0] + (b[0] - a[0]) * f));
    t.y_m.push(r3(a[1] + (b[1] - a[1]) * f));
    t.heading_rad.push(Math.round(h * 1e4) / 1e4);
    t.vx_mps.push(r3(v * Math.cos(h)));
    t.vy_mps.push(r3(v * Math.sin(h)));
    d += v * 0.1;
  }
  return t;
}

export function buildCrossing(id = 'demo-crossing', name = 'Test crossing') {
  const ls = lanes();
  const by = Object.fromEntries(ls.map((l) => [l.id, l.points_m]));
  const { lines, edges, crosswalks } = markings();
  const chain = (skip, ...ids) => {
    const pts = ids.flatMap((i, k) => (k ? by[i].slice(1) : by[i]));
    const first = pts[0],
      second = pts[1],
      l = Math.hypot(second[0] - first[0], second[1] - first[1]);
    void l;
    return cut(pts, skip);
  };
  const cut = (pts, skip) => {
    let left = skip;
    for (let i = 1; i < pts.length; i++) {
      const d = Math.hypot(pts[i][0] - pts[i - 1][0], pts[i][1] - pts[i - 1][1]);
      if (left < d)
        return [
          [
            pts[i - 1][0] + ((pts[i][0] - pts[i - 1][0]) * left) / d,
            pts[i - 1][1] + ((pts[i][1] - pts[i - 1][1]) * left) / d,
          ],
          ...pts.slice(i),
        ];
      left -= d;
    }
    return pts;
  };
  const agents = [];
  const add = (type, subtype, [l, w], track) =>
    agents.push({
      id: String(agents.length + 1),
      type,
      subtype,
      role: agents.length ? 'none' : 'ego',
      length_m: l,
      width_m: w,
      height_m: 1.5,
      track,
      conditions: {},
    });
  const car = [4.6, 1.9];
  add('vehicle', 'car', car, drive(chain(50, 'in20', 'x_in20_out10', 'out10'), 8.9, 8.4));
  add('vehicle', 'car', car, drive(chain(48, 'in01', 'x_in01_out21', 'out21'), 9.6, 9.2));
  add('vehicle', 'car', car, drive(chain(76, 'in00', 'x_in00_out20', 'out20'), 6, 9));
  add('vehicle', 'bus', [12, 2.6], drive(chain(26, 'in01', 'x_in01_out21', 'out21'), 8, 8));
  add('vehicle', 'truck', [8.6, 2.5], drive(chain(30, 'in21', 'x_in21_out01', 'out01'), 8.6, 9));
  add('vehicle', 'car', car, drive(chain(62, 'in21', 'x_in21_out01', 'out01'), 9.4, 11));
  add('vehicle', 'car', car, drive(chain(86, 'in10'), 0, 0));
  add('vehicle', 'car', car, drive(chain(78, 'in10'), 0, 0));
  add('vehicle', 'car', car, drive(chain(60, 'in11', 'x_in11_out31'), 7, 4, 28));
  add('vehicle', 'car', car, drive(chain(87, 'in30'), 0, 0));
  add('vehicle', 'motorcycle', [2.2, 0.85], drive(chain(86, 'in31', 'x_in31_out01', 'out01'), 5, 9));
  add('vehicle', 'car', car, drive(chain(20, 'out20'), 11, 12));
  add('vehicle', 'car', car, drive(chain(30, 'out00'), 12, 12.5));
  add('cyclist', 'bicycle', [1.8, 0.65], drive(chain(60, 'bin2', 'x_bin2_bout0', 'bout0'), 5.4, 5.6));
  add('cyclist', 'bicycle', [1.8, 0.65], drive(chain(40, 'bin0', 'x_bin0_bout2', 'bout2'), 5, 5.6));
  add('cyclist', 'bicycle', [1.8, 0.65], drive(chain(90, 'bin1'), 0, 0));
  const walk = (...pts) => drive(pts, 1.4, 1.3);
  add('pedestrian', 'adult', [0.6, 0.6], walk(at(ARMS[1], 12.5, 9.5), at(ARMS[1], 12.8, -9.5), at(ARMS[1], 14, -16)));
  add('pedestrian', 'adult', [0.6, 0.6], walk(at(ARMS[3], 12.4, -6), at(ARMS[3], 12.6, 12)));
  add('pedestrian', 'adult', [0.6, 0.6], walk(at(ARMS[0], 30, 11), at(ARMS[0], 60, 11.4)));
  add('pedestrian', 'child', [0.5, 0.5], walk(at(ARMS[0], 30.8, 12), at(ARMS[0], 60, 12.2)));
  add('pedestrian', 'adult', [0.6, 0.6], drive([at(ARMS[2], 14, -12), at(ARMS[2], 14, -13)], 0, 0));
  for (let i = 0; i < 8; i++)
    add(
      'vehicle',
      'car',
      [4.2 + (i % 3) * 0.3, 1.82],
      drive([at(ARMS[0], 34 + i * 2.9, -18), at(ARMS[0], 34 + i * 2.9, -20)], 0, 0),
    );
  const signals = [];
  for (let i = 0; i < 4; i++)
    for (const l of ls.filter((x) => x.id.startsWith(`x_in${i}`)))
      signals.push({
        lane: l.id,
        stop_m: l.points_m[0],
        states:
          i % 2
            ? [
                [0, 'stop'],
                [80, 'go'],
              ]
            : [
                [0, 'go'],
                [70, 'caution'],
                [80, 'stop'],
              ],
      });
  const n = (t) => agents.filter((a) => a.type === t).length;
  return {
    counts: { vehicle: n('vehicle'), pedestrian: n('pedestrian'), cyclist: n('cyclist'), other: 0 },
    scene: {
      format: 'dragtraffic.scene',
      version: 1,
      id,
      name,
      meta: {
        source: 'drawn',
        licence: 'MIT',
        origin: { x_m: 0, y_m: 0, z_m: 0, rotation_rad: 0, crs: null },
        parent_id: null,
        tags: [],
        notes: '',
        created_with: '0.1.0',
      },
      time: { step_s: 0.1, steps: STEPS, now_step: 0 },
      map: {
        lanes: ls,
        road_lines: lines,
        road_edges: edges,
        crosswalks,
        speed_bumps: [],
        driveways: [],
        stop_signs: [],
        drivable: [],
      },
      signals,
      agents,
      generated: null,
    },
  };
}
