// A scene on a canvas: it plays, and a road user that is dragged gets the place where it is let go as its goal.

const LINES = [["edges", "#5b616b", 1.4], ["lines", "#c9cdd3", 1], ["lanes", "#dfe2e7", 1]];

function element(name, parent, style = "", more = {}) {
  const made = Object.assign(document.createElement(name), more);
  made.style.cssText = style;
  parent.append(made);
  return made;
}

function outline(context, points, closed) {
  context.beginPath();
  points.forEach(([x, y], i) => (i ? context.lineTo(x, y) : context.moveTo(x, y)));
  if (closed) context.closePath();
}

/** Metres of the scene to pixels of the canvas: y is up. */
class View {
  constructor({ x_m, y_m, half_m }, width, height) {
    Object.assign(this, { x_m, y_m, width, height, scale: Math.min(width, height) / (2 * half_m) });
  }
  apply(context, ratio) {
    const s = this.scale * ratio;
    context.setTransform(s, 0, 0, -s, (ratio * this.width) / 2 - s * this.x_m, (ratio * this.height) / 2 + s * this.y_m);
  }
  place(event) {
    const x = this.x_m + (event.offsetX - this.width / 2) / this.scale;
    return [x, this.y_m - (event.offsetY - this.height / 2) / this.scale];
  }
  zoom(event) {
    const before = this.place(event);
    this.scale *= Math.exp(-0.001 * event.deltaY);
    const after = this.place(event);
    this.x_m += before[0] - after[0];
    this.y_m += before[1] - after[1];
  }
}

function draw(context, view, ratio, map, motion, step) {
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.fillStyle = "#ffffff";
  context.fillRect(0, 0, context.canvas.width, context.canvas.height);
  view.apply(context, ratio);
  const pixel = 1 / view.scale;
  context.fillStyle = "#eceef1";
  for (const area of map.areas) outline(context, area, true), context.fill();
  context.fillStyle = "#dfe2e7";
  for (const area of map.crosswalks) outline(context, area, true), context.fill();
  for (const [name, colour, width] of LINES) {
    context.strokeStyle = colour;
    context.lineWidth = width * pixel;
    for (const line of map[name]) outline(context, line, false), context.stroke();
  }
  for (const agent of map.agents) {
    const colour = map.colours[agent.type] ?? map.colours.other;
    const future = motion.futures[agent.id];
    context.strokeStyle = context.fillStyle = colour;
    context.lineWidth = 2 * pixel;
    if (future) outline(context, future, false), context.stroke();
    const goal = motion.goals[agent.id];
    if (goal) {
      context.beginPath();
      context.arc(goal[0], goal[1], 6 * pixel, 0, 2 * Math.PI);
      context.fill();
    }
    const pose = motion.poses[agent.id][step];
    if (!pose) continue;
    context.save();
    context.translate(pose[0], pose[1]);
    context.rotate(pose[2]);
    context.beginPath();
    context.rect(-agent.length_m / 2, -agent.width_m / 2, agent.length_m, agent.width_m);
    context.fillStyle = future ? colour : "#ffffff";
    context.fill();
    context.lineWidth = pixel;
    context.stroke();
    context.restore();
  }
}

function render({ model, el }) {
  const canvas = element("canvas", el, "box-sizing:border-box;width:100%;height:480px;border:1px solid #c9cdd3;touch-action:none");
  const bar = element("div", el, "display:flex;gap:8px;align-items:center;font:13px sans-serif");
  const button = element("button", bar, "width:64px", { textContent: "Play", type: "button" });
  const slider = element("input", bar, "flex:1", { type: "range", min: 0, value: 0, ariaLabel: "Step" });
  const clock = element("span", bar, "width:48px;text-align:right");
  const told = element("div", el, "font:13px sans-serif;min-height:18px", { role: "status" });
  const context = canvas.getContext("2d");
  let view = null;
  let timer = null;
  // The road user that is dragged, the place that waits for the engine, and whether it computes.
  let held = null;
  let waiting = null;
  let busy = false;

  const map = () => model.get("_map");
  const motion = () => model.get("_motion");
  function show() {
    const { width, height } = canvas.getBoundingClientRect();
    if (!width) return;
    const ratio = window.devicePixelRatio || 1;
    Object.assign(canvas, { width: width * ratio, height: height * ratio });
    view ??= new View(map().look, width, height);
    Object.assign(view, { width, height });
    slider.max = motion().steps - 1;
    clock.textContent = `${(slider.value * map().step_s).toFixed(1)} s`;
    draw(context, view, ratio, map(), motion(), Number(slider.value));
  }
  function stop() {
    clearInterval(timer);
    timer = null;
    button.textContent = "Play";
  }
  button.onclick = () => {
    if (timer) return stop();
    if (Number(slider.value) >= motion().steps - 1) slider.value = 0;
    button.textContent = "Pause";
    timer = setInterval(() => {
      slider.value = Number(slider.value) + 1;
      show();
      if (Number(slider.value) >= motion().steps - 1) stop();
    }, 1000 * map().step_s);
  };
  slider.oninput = show;

  function ask() {
    if (busy || !waiting) return;
    model.send({ kind: "goal", ...waiting });
    [busy, waiting] = [true, null];
    told.textContent = "…";
  }
  /** Whose goal or box is within a few pixels of a place. */
  function under([x, y]) {
    const near = 10 / view.scale;
    const away = (at) => (at ? Math.hypot(at[0] - x, at[1] - y) : Infinity);
    const goal = Object.keys(motion().goals).find((id) => away(motion().goals[id]) < near);
    const reach = (agent) => Math.max(near, agent.length_m / 2);
    const box = (agent) => away(motion().poses[agent.id][slider.value]) < reach(agent);
    return goal ?? map().agents.find(box)?.id ?? null;
  }
  canvas.onpointerdown = (event) => {
    canvas.setPointerCapture(event.pointerId);
    const id = model.get("draggable") ? under(view.place(event)) : null;
    held = { id, from: view.place(event) };
  };
  canvas.onpointermove = (event) => {
    if (!held) {
      canvas.style.cursor = model.get("draggable") && under(view.place(event)) ? "grab" : "default";
      return;
    }
    const [x, y] = view.place(event);
    if (held.id === null) {
      view.x_m += held.from[0] - x;
      view.y_m += held.from[1] - y;
    } else if (Math.hypot(x - held.from[0], y - held.from[1]) > 4 / view.scale) {
      waiting = { agent: held.id, x_m: x, y_m: y };
      ask();
    }
    show();
  };
  canvas.onpointerup = canvas.onpointercancel = () => (held = null);
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    view.zoom(event);
    show();
  });
  const answered = (message) => {
    if (message.kind !== "answered") return;
    busy = false;
    told.textContent = message.told;
    ask();
  };
  model.on("msg:custom", answered);
  model.on("change:_motion", show);
  const resized = new ResizeObserver(show);
  resized.observe(canvas);
  return () => {
    stop();
    resized.disconnect();
    model.off("change:_motion", show);
    model.off("msg:custom", answered);
  };
}

export default { render };
