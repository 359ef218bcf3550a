// Pictures of cases: maps, and the motion of a few road users, drawn on a canvas.
'use strict';

/**
 * @typedef {{ id: string, kind: string, size: [number, number], from: number, poses: number[] }} AgentMotion
 * @typedef {{ first: number, place: [number, number], moment: number, agents: AgentMotion[] }} Motion
 * @typedef {{ lanes: { kind: number, width: number, line: Path2D }[], edges: Path2D, crosswalks: Path2D }} DrawnMap
 * @typedef {{ x: number, y: number, heading: number }} Pose
 * @typedef {{ x: number, y: number, z: number }} View
 */

/** Seconds between two poses of a motion. */
const PICTURE_S = 0.5;
const motionLines = el('motions').textContent.trim().split('\n');
const mapLines = el('maps').textContent.trim().split('\n');
/** @type {Map<number, Motion | null>} */
const motionsRead = new Map();
/** @type {Map<number, DrawnMap | null>} */
const mapsRead = new Map();

/**
 * The motion of a case in metres; null where nobody is seen.
 * @param {number} index
 * @returns {Motion | null}
 */
function motionOf(index) {
  const known = motionsRead.get(index);
  if (known !== undefined) return known;
  const line = motionLines[index];
  const motion = line ? /** @type {Motion} */ (JSON.parse(line)) : null;
  for (const agent of motion?.agents ?? [])
    for (let i = 3; i < agent.poses.length; i++) agent.poses[i] += agent.poses[i - 3];
  // A page of ten thousand cases keeps the motions of the last thousand.
  if (motionsRead.size >= 1000) motionsRead.clear();
  motionsRead.set(index, motion);
  return motion;
}

/**
 * A path of the first point and differences, decimetres.
 * @param {number[]} steps
 * @param {Path2D} path
 * @param {boolean} isClosed
 */
function addLine(steps, path, isClosed) {
  let [x, y] = [0, 0];
  for (let i = 0; i + 1 < steps.length; i += 2) {
    x += steps[i] / 10;
    y += steps[i + 1] / 10;
    if (i === 0) path.moveTo(x, y);
    else path.lineTo(x, y);
  }
  if (isClosed) path.closePath();
  return path;
}

/** @param {number | null} scene */
function mapOf(scene) {
  if (scene === null) return null;
  const known = mapsRead.get(scene);
  if (known !== undefined) return known;
  const read = JSON.parse(mapLines[scene] || 'null');
  /** @type {DrawnMap | null} */
  let map = null;
  if (read) {
    map = { lanes: [], edges: new Path2D(), crosswalks: new Path2D() };
    for (const [kind, width, line] of read.lanes)
      map.lanes.push({ kind, width: width / 10, line: addLine(line, new Path2D(), false) });
    for (const line of read.edges) addLine(line, map.edges, false);
    for (const ring of read.crosswalks) addLine(ring, map.crosswalks, true);
  }
  mapsRead.set(scene, map);
  return map;
}

/**
 * Pose at a time in seconds from the first picture; null before the first pose and after the last.
 * @param {AgentMotion} agent
 * @param {number} time
 * @returns {Pose | null}
 */
function poseAt(agent, time) {
  const at = time / PICTURE_S - agent.from;
  const last = agent.poses.length / 3 - 1;
  if (at < 0 || at > last) return null;
  const [i, j] = [Math.floor(at), Math.min(Math.floor(at) + 1, last)];
  /** @param {number} k */
  const mix = (k) => agent.poses[3 * i + k] + (agent.poses[3 * j + k] - agent.poses[3 * i + k]) * (at - i);
  return { x: mix(0) / 10, y: mix(1) / 10, heading: mix(2) / 100 };
}

/**
 * Seconds until the actor is no longer seen; others may go on longer.
 * @param {Motion} motion
 */
const lengthOf = ({ agents: [actor] }) => (actor ? (actor.from + actor.poses.length / 3 - 1) * PICTURE_S : 0);

/** Colours of the page by name; they change with the theme. */
let colours = /** @type {Record<string, string>} */ ({});
/** @param {string} name */
const colour = (name) =>
  (colours[name] ??= getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim());

/**
 * A view of the ways of the two that meet, around their place.
 * @param {Motion} motion
 * @param {number} width
 * @param {number} height
 * @returns {View}
 */
function viewOf(motion, width, height) {
  const [x, y] = motion.place.map((of) => of / 10);
  let [wide, high] = [14, 10];
  // The two that meet, near the place.
  for (const agent of motion.agents.slice(0, 2))
    for (let i = 0; i < agent.poses.length; i += 3) {
      wide = Math.max(wide, Math.abs(agent.poses[i] / 10 - x) + 6);
      high = Math.max(high, Math.abs(agent.poses[i + 1] / 10 - y) + 6);
    }
  return { x, y, z: Math.min(width / (2 * Math.min(wide, 45)), height / (2 * Math.min(high, 30)), 14) };
}

/**
 * Draws a case at a time.
 * @param {HTMLCanvasElement} canvas
 * @param {Case} of
 * @param {number | null} time Seconds; null is the moment of the least gap.
 */
function drawCase(canvas, of, time) {
  // A small picture is drawn once: the way through the graphics card costs more than the drawing.
  const g = canvas.getContext('2d', { willReadFrequently: time === null });
  const motion = motionOf(of.index);
  const { clientWidth: width, clientHeight: height } = canvas;
  if (!g || !width || !height) return;
  const dpr = window.devicePixelRatio || 1;
  const [w, h] = [Math.round(width * dpr), Math.round(height * dpr)];
  if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
  g.setTransform(1, 0, 0, 1, 0, 0);
  g.fillStyle = colour('map-ground');
  g.fillRect(0, 0, w, h);
  if (!motion) return;
  const view = viewOf(motion, width, height);
  const z = view.z * dpr;
  g.setTransform(z, 0, 0, -z, w / 2 - view.x * z, h / 2 + view.y * z);
  drawMap(g, mapOf(of.scene), 1 / view.z);
  const now = time ?? motion.moment * PICTURE_S;
  motion.agents.slice(0, 2).forEach((agent, i) => drawWay(g, agent, i === 0 ? 'goal' : 'ink-2', 1 / view.z));
  motion.agents.forEach((agent, i) => drawAgent(g, agent, now, i));
}

/**
 * @param {CanvasRenderingContext2D} g
 * @param {DrawnMap | null} map
 * @param {number} px Metres of a pixel.
 */
function drawMap(g, map, px) {
  if (!map) return;
  g.lineJoin = 'round';
  g.lineCap = 'butt';
  for (const { kind, width, line } of map.lanes) {
    g.strokeStyle = colour(['map-asphalt', 'map-bike', 'map-sidewalk'][kind]);
    g.lineWidth = width + 0.4;
    g.stroke(line);
  }
  g.fillStyle = colour('map-crosswalk');
  g.globalAlpha = 0.6;
  g.fill(map.crosswalks);
  g.globalAlpha = 1;
  g.strokeStyle = colour('map-kerb');
  g.lineWidth = Math.max(0.2, 0.8 * px);
  g.stroke(map.edges);
}

/**
 * @param {CanvasRenderingContext2D} g
 * @param {AgentMotion} agent
 * @param {string} name
 * @param {number} px
 */
function drawWay(g, agent, name, px) {
  g.strokeStyle = colour(name);
  g.lineWidth = Math.max(0.3, 1.5 * px);
  g.beginPath();
  for (let i = 0; i < agent.poses.length; i += 3) g.lineTo(agent.poses[i] / 10, agent.poses[i + 1] / 10);
  g.stroke();
}

/**
 * @param {CanvasRenderingContext2D} g
 * @param {AgentMotion} agent
 * @param {number} time
 * @param {number} place
 */
function drawAgent(g, agent, time, place) {
  const pose = poseAt(agent, time);
  if (!pose) return;
  const [length, width] = agent.size.map((of) => of / 10);
  g.save();
  g.translate(pose.x, pose.y);
  g.rotate(pose.heading);
  g.globalAlpha = place < 2 ? 1 : 0.55;
  g.fillStyle = colour(['vehicle', 'pedestrian', 'cyclist'].includes(agent.kind) ? agent.kind : 'parked');
  g.strokeStyle = colour(place === 0 ? 'ink' : 'halo');
  g.lineWidth = place === 0 ? 0.35 : 0.2;
  g.beginPath();
  if (agent.kind === 'pedestrian') g.arc(0, 0, Math.max(length, width, 0.6) / 2, 0, 7);
  else g.roundRect(-length / 2, -width / 2, length, width, Math.min(length, width) / 4);
  g.fill();
  g.stroke();
  g.restore();
}
