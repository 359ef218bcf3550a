// The player of an exported page: everything that it shows stands in the script element "scene".
'use strict';
(() => {
  const scene = JSON.parse(document.getElementById('scene').textContent);
  const el = (id) => document.getElementById(id);
  const canvas = el('view');
  const g = canvas.getContext('2d');
  const last = Math.max(scene.steps - 1, 0);
  const style = getComputedStyle(document.documentElement);
  let colours = {};
  /** Step, may lie between two; the view: metres in the middle and pixels a metre; who is picked. */
  let step = 0;
  let view = { x: 0, y: 0, z: 4 };
  let playing = false;
  let picked = null;
  let before = 0;
  let moved = false;

  const colour = (name) => (colours[name] ??= style.getPropertyValue(`--${name}`).trim());

  /** A path of x, y, x, y, ... in metres. */
  function path(points, closed) {
    const made = new Path2D();
    for (let i = 0; i + 1 < points.length; i += 2) made.lineTo(points[i], points[i + 1]);
    if (closed) made.closePath();
    return made;
  }
  function area(rings) {
    const made = new Path2D();
    for (const ring of rings) made.addPath(path(ring, true));
    return made;
  }

  const { map } = scene;
  const drawn = {
    drivable: map.drivable.map(area),
    driveways: map.driveways.map(area),
    lanes: map.lanes.map(([kind, width, points]) => ({
      kind,
      width,
      line: path(points),
    })),
    edges: map.edges.map(([type, points]) => ({ type, line: path(points) })),
    lines: map.lines.map(([type, points]) => ({ type, line: path(points) })),
    crosswalks: map.crosswalks.map((rings) => ({
      shape: area(rings),
      ring: rings[0],
    })),
  };

  /** Pose at the step; null where nobody saw the road user. */
  function poseOf(agent, at) {
    const i = Math.floor(at) - agent.first;
    const part = at - Math.floor(at);
    if (i < 0 || i >= agent.x.length || agent.x[i] === null) return null;
    const next = part > 0 && i + 1 < agent.x.length && agent.x[i + 1] !== null;
    const mix = (list) => (next ? list[i] + (list[i + 1] - list[i]) * part : list[i]);
    const turn = next ? agent.heading[i + 1] - agent.heading[i] : 0;
    const short = Math.atan2(Math.sin(turn), Math.cos(turn));
    return {
      x: mix(agent.x),
      y: mix(agent.y),
      heading: agent.heading[i] + short * part,
      speed: mix(agent.speed),
    };
  }

  function stateOf(signal, at) {
    let state = 'unknown';
    for (const [first, name] of signal.runs) if (first <= at) state = name;
    return state;
  }

  /** All that moves, else the road. */
  function fit() {
    const xs = [];
    const ys = [];
    for (const a of scene.agents)
      for (let i = 0; i < a.x.length; i++)
        if (a.x[i] !== null) {
          xs.push(a.x[i]);
          ys.push(a.y[i]);
        }
    if (!xs.length)
      for (const [, , points] of map.lanes)
        for (let i = 0; i < points.length; i += 2) {
          xs.push(points[i]);
          ys.push(points[i + 1]);
        }
    if (!xs.length) return;
    const ends = (list) =>
      list.reduce(([low, high], v) => [Math.min(low, v), Math.max(high, v)], [Infinity, -Infinity]);
    const [x0, x1] = ends(xs);
    const [y0, y1] = ends(ys);
    const { width, height } = canvas.getBoundingClientRect();
    const room = Math.min(width / (x1 - x0 + 24), height / (y1 - y0 + 24));
    view = {
      x: (x0 + x1) / 2,
      y: (y0 + y1) / 2,
      z: Math.min(Math.max(room, 0.2), 16),
    };
  }

  function paint() {
    const { width, height } = canvas.getBoundingClientRect();
    const dpr = window.devicePixelRatio || 1;
    const size = [Math.round(width * dpr), Math.round(height * dpr)];
    if (canvas.width !== size[0] || canvas.height !== size[1]) [canvas.width, canvas.height] = size;
    g.setTransform(1, 0, 0, 1, 0, 0);
    g.fillStyle = colour('map-ground');
    g.fillRect(0, 0, canvas.width, canvas.height);
    const z = view.z * dpr;
    g.setTransform(z, 0, 0, -z, canvas.width / 2 - view.x * z, canvas.height / 2 + view.y * z);
    paintMap(1 / view.z);
    paintSignals();
    for (const agent of scene.agents) paintAgent(agent);
    g.setTransform(dpr, 0, 0, dpr, 0, 0);
    if (el('names').checked) scene.agents.forEach(paintName);
  }

  function stroke(line, name, width, dash = []) {
    g.strokeStyle = colour(name);
    g.lineWidth = width;
    g.setLineDash(dash);
    g.stroke(line);
    g.setLineDash([]);
  }

  function paintMap(px) {
    g.lineJoin = 'round';
    g.lineCap = 'round';
    const roads = drawn.lanes.filter((l) => l.kind !== 'walk');
    for (const l of drawn.lanes) stroke(l.line, 'map-sidewalk', l.kind === 'walk' ? 3 : l.width + 6.8);
    for (const shape of drawn.drivable) stroke(shape, 'map-sidewalk', 6.8);
    g.lineCap = drawn.drivable.length ? 'butt' : 'round';
    for (const l of roads) stroke(l.line, 'map-asphalt', drawn.drivable.length ? l.width : l.width + 0.6);
    g.fillStyle = colour('map-asphalt');
    for (const shape of [...drawn.driveways, ...drawn.drivable]) g.fill(shape, 'evenodd');
    for (const l of roads) if (l.kind === 'bike') stroke(l.line, 'map-bike', Math.min(l.width, 2.4));
    g.lineCap = 'butt';
    for (const c of drawn.crosswalks) paintCrosswalk(c);
    for (const e of drawn.edges) stroke(e.line, 'map-kerb', Math.max(1.4 * px, 0.24));
    for (const l of drawn.lines)
      stroke(
        l.line,
        l.type.includes('yellow') ? 'map-yellow' : 'map-line',
        Math.max(0.14, 0.8 * px) * (l.type.includes('double') ? 2 : 1),
        l.type.startsWith('broken') ? [3, 4.5] : [],
      );
  }

  /** Bars along the traffic, that is across the longer sides. */
  function paintCrosswalk({ shape, ring }) {
    let longest = [0, 0];
    for (let i = 0; i < ring.length; i += 2) {
      const [nx, ny] = [ring[(i + 2) % ring.length] - ring[i], ring[(i + 3) % ring.length] - ring[i + 1]];
      if (Math.hypot(nx, ny) > Math.hypot(...longest)) longest = [nx, ny];
    }
    const length = Math.hypot(...longest);
    if (!length) return;
    const mid = [0, 0];
    for (let i = 0; i < ring.length; i += 2) {
      mid[0] += ring[i] / (ring.length / 2);
      mid[1] += ring[i + 1] / (ring.length / 2);
    }
    g.save();
    g.clip(shape);
    const [ux, uy] = [longest[0] / length, longest[1] / length];
    const bars = new Path2D();
    for (let s = -length; s < length; s += 1.2) {
      bars.moveTo(mid[0] + ux * s - uy * 20, mid[1] + uy * s + ux * 20);
      bars.lineTo(mid[0] + ux * s + uy * 20, mid[1] + uy * s - ux * 20);
    }
    stroke(bars, 'map-crosswalk', 0.6);
    g.restore();
  }

  function paintSignals() {
    for (const signal of scene.signals) {
      const state = stateOf(signal, step);
      g.fillStyle = state.includes('stop')
        ? '#d3202f'
        : state.includes('caution')
          ? '#e9a100'
          : state.includes('go')
            ? '#1f9d55'
            : '#8794a6';
      g.beginPath();
      g.arc(signal.at[0], signal.at[1], 0.8, 0, 7);
      g.fill();
      g.strokeStyle = colour('halo');
      g.lineWidth = 0.25;
      g.stroke();
    }
  }

  const nameOf = (agent) => (agent.role === 'ego' ? 'ego' : agent.id);
  const isParked = (agent) => agent.role === 'parked';

  function paintAgent(agent) {
    if (agent === picked || agent.goal) paintWay(agent);
    const pose = poseOf(agent, step);
    if (!pose) return;
    const [length, width] = agent.size;
    g.save();
    g.translate(pose.x, pose.y);
    g.rotate(pose.heading);
    g.fillStyle = colour(isParked(agent) ? 'other' : agent.type);
    g.strokeStyle = colour(agent === picked ? 'ink' : 'halo');
    g.lineWidth = agent === picked ? 0.4 : 0.15;
    g.beginPath();
    if (agent.type === 'pedestrian') g.arc(0, 0, Math.max(length, width) / 2, 0, 7);
    else g.roundRect(-length / 2, -width / 2, length, width, Math.min(length, width) / 4);
    g.fill();
    g.stroke();
    if (agent.type !== 'pedestrian') {
      // The front.
      g.fillStyle = colour('halo');
      g.globalAlpha = 0.7;
      g.beginPath();
      g.roundRect(length * 0.12, -width * 0.36, length * 0.16, width * 0.72, width / 10);
      g.fill();
    }
    g.restore();
  }

  /** Where it goes from now on, and its goal. */
  function paintWay(agent) {
    const line = new Path2D();
    for (let i = Math.max(Math.floor(step) - agent.first, 0); i < agent.x.length; i++)
      if (agent.x[i] !== null) line.lineTo(agent.x[i], agent.y[i]);
    g.globalAlpha = 0.7;
    stroke(line, agent.generated_from === null ? 'ink-2' : 'goal', 0.35);
    g.globalAlpha = 1;
    if (!agent.goal) return;
    g.strokeStyle = colour('goal');
    g.lineWidth = 0.5;
    g.beginPath();
    g.arc(agent.goal[0], agent.goal[1], 1.4, 0, 7);
    g.stroke();
  }

  function paintName(agent) {
    const pose = poseOf(agent, step);
    if (!pose || ((view.z < 2.5 || isParked(agent)) && agent !== picked)) return;
    const { width, height } = canvas.getBoundingClientRect();
    const [x, y] = [width / 2 + (pose.x - view.x) * view.z, height / 2 - (pose.y - view.y) * view.z];
    g.font = '500 11px system-ui, sans-serif';
    g.textAlign = 'center';
    g.lineWidth = 3;
    g.lineJoin = 'round';
    g.strokeStyle = colour('halo');
    const up = y - Math.max(agent.size[1] * view.z, 12) / 2 - 5;
    g.strokeText(nameOf(agent), x, up);
    g.fillStyle = colour('ink');
    g.fillText(nameOf(agent), x, up);
  }

  function show() {
    const time = (at) => (at * scene.step_s).toFixed(1);
    el('time').value = String(Math.round(step));
    el('time').setAttribute('aria-valuetext', `${time(step)} seconds`);
    el('clock').value = `${time(step)} / ${time(last)} s`;
    el('play').textContent = playing ? 'Halt' : 'Play';
    el('play').setAttribute('aria-pressed', String(playing));
    const pose = picked && poseOf(picked, step);
    const made = picked && picked.generated_from !== null && step >= picked.generated_from ? ', generated' : '';
    const told = picked ? `${picked.type} ${nameOf(picked)}: ` : '';
    el('told').textContent = told && (pose ? `${told}${(pose.speed * 3.6).toFixed(0)} km/h${made}` : `${told}not seen`);
    paint();
  }

  function tick(now) {
    if (!playing) return;
    step += ((now - before) / 1000 / scene.step_s) * Number(el('pace').value);
    before = now;
    if (step >= last) {
      step = last;
      playing = false;
    }
    show();
    requestAnimationFrame(tick);
  }
  function play(on) {
    playing = on && last > 0;
    if (playing && step >= last) step = 0;
    before = performance.now();
    show();
    if (playing) requestAnimationFrame(tick);
  }
  function go(to) {
    playing = false;
    step = Math.min(Math.max(Math.round(to), 0), last);
    show();
  }

  function zoom(factor, x, y) {
    const { width, height } = canvas.getBoundingClientRect();
    const [dx, dy] = [x - width / 2, y - height / 2];
    const z = Math.min(Math.max(view.z * factor, 0.1), 60);
    view = {
      x: view.x + dx / view.z - dx / z,
      y: view.y - dy / view.z + dy / z,
      z,
    };
    moved = true;
    show();
  }
  function zoomHere(factor) {
    const { width, height } = canvas.getBoundingClientRect();
    zoom(factor, width / 2, height / 2);
  }
  function pan(dx, dy) {
    view = { ...view, x: view.x - dx / view.z, y: view.y + dy / view.z };
    moved = true;
    show();
  }
  function fitAndShow() {
    moved = false;
    fit();
    show();
  }

  const fingers = new Map();
  let pressed = null;
  canvas.addEventListener('pointerdown', (e) => {
    canvas.setPointerCapture(e.pointerId);
    fingers.set(e.pointerId, e);
    pressed = { x: e.clientX, y: e.clientY };
  });
  canvas.addEventListener('pointermove', (e) => {
    const old = fingers.get(e.pointerId);
    if (!old) return;
    const others = [...fingers.values()].filter((f) => f.pointerId !== e.pointerId);
    if (others.length) {
      const far = (p) => Math.hypot(p.clientX - others[0].clientX, p.clientY - others[0].clientY);
      const box = canvas.getBoundingClientRect();
      zoom(far(e) / Math.max(far(old), 1), others[0].clientX - box.left, others[0].clientY - box.top);
    } else pan(e.clientX - old.clientX, e.clientY - old.clientY);
    fingers.set(e.pointerId, e);
  });
  const up = (e) => {
    fingers.delete(e.pointerId);
    if (e.type === 'pointerup' && pressed && Math.hypot(e.clientX - pressed.x, e.clientY - pressed.y) < 4) pick(e);
    pressed = null;
  };
  canvas.addEventListener('pointerup', up);
  canvas.addEventListener('pointercancel', up);
  canvas.addEventListener(
    'wheel',
    (e) => {
      e.preventDefault();
      zoom(Math.exp(-e.deltaY / 400), e.offsetX, e.offsetY);
    },
    { passive: false },
  );

  function pick(e) {
    const { left, top, width, height } = canvas.getBoundingClientRect();
    const [x, y] = [view.x + (e.clientX - left - width / 2) / view.z, view.y - (e.clientY - top - height / 2) / view.z];
    const reach = Math.max(8 / view.z, 1);
    const near = scene.agents
      .map((agent) => ({ agent, pose: poseOf(agent, step) }))
      .filter(({ pose }) => pose)
      .map(({ agent, pose }) => ({
        agent,
        far: Math.hypot(pose.x - x, pose.y - y) - agent.size[0] / 2,
      }))
      .sort((a, b) => a.far - b.far)[0];
    picked = near && near.far < reach ? near.agent : null;
    show();
  }

  const KEYS = {
    ' ': () => play(!playing),
    k: () => play(!playing),
    ArrowLeft: () => go(step - 1),
    ArrowRight: () => go(step + 1),
    Home: () => go(0),
    End: () => go(last),
    '+': () => zoomHere(1.25),
    '=': () => zoomHere(1.25),
    '-': () => zoomHere(0.8),
    0: fitAndShow,
    n: () => {
      el('names').checked = !el('names').checked;
      show();
    },
    Escape: () => {
      picked = null;
      show();
    },
  };
  const MOVES = {
    ArrowLeft: [40, 0],
    ArrowRight: [-40, 0],
    ArrowUp: [0, 40],
    ArrowDown: [0, -40],
  };
  document.addEventListener('keydown', (e) => {
    // Buttons, boxes and lists have keys of their own.
    const own = e.target.closest?.('button, select, input');
    if (e.ctrlKey || e.metaKey || e.altKey || (own && [' ', 'ArrowLeft', 'ArrowRight', 'Home', 'End'].includes(e.key)))
      return;
    const act = e.shiftKey && MOVES[e.key] ? () => pan(...MOVES[e.key]) : KEYS[e.key];
    if (!act) return;
    e.preventDefault();
    act();
  });
  el('play').addEventListener('click', () => play(!playing));
  el('time').addEventListener('input', () => go(Number(el('time').value)));
  el('names').addEventListener('change', show);
  el('fit').addEventListener('click', fitAndShow);
  new ResizeObserver(() => {
    if (!moved) fit();
    show();
  }).observe(canvas);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
    colours = {};
    show();
  });

  el('name').textContent = scene.name || 'Scene';
  const count = scene.agents.length;
  const licence = scene.licence ? `; licence: ${scene.licence}` : '';
  el('about').textContent =
    `${count} road ${count === 1 ? 'user' : 'users'}, ${(last * scene.step_s).toFixed(1)} s${licence}`;
  el('time').max = String(last);
  canvas.setAttribute('aria-label', `${scene.name || 'Scene'} from above, ${count} road users`);
  fit();
  show();
})();
