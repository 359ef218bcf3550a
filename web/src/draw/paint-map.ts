// The road: ground, kerbs, asphalt, bike lanes, crosswalks, lines, arrows. Drawn in metres under one transform.
import type { Pen } from './pen';
import { pointAt, wrapAngle, type Box, type Vec } from '../model/base/geometry';
import { nearestLanes, turnOf, type Lane, type LaneMap } from '../model/document/lanemap';
import { TileLayer } from './tiles';
import { colours } from './theme';
import type { View } from './view';

interface Stripe {
  readonly a: Vec;
  readonly b: Vec;
  readonly width: number;
}
interface Arrow {
  readonly x: number;
  readonly y: number;
  readonly heading: number;
  readonly ways: string;
}

/** Recorded maps have lanes but no road surface; wide bands close the gaps between neighbours. */
const BAND_M = 5.2;

export class MapPicture {
  private readonly roads = new Map<number, TileLayer>();
  private readonly openRoads = new Map<number, TileLayer>();
  private readonly drivable = new TileLayer();
  private readonly bike = new Map<number, TileLayer>();
  private readonly walks = new TileLayer();
  private readonly driveways = new TileLayer();
  private readonly bumps = new TileLayer();
  private readonly kerbs = new TileLayer();
  private readonly lines = new Map<string, TileLayer>();
  private readonly outlines = new TileLayer();
  private readonly stripes: Stripe[];
  private readonly arrows: Arrow[];

  constructor(
    private readonly map: LaneMap,
    private readonly recorded: boolean,
  ) {
    for (const lane of map.lanes.values()) this.addLane(lane);
    for (const d of map.drivable) {
      this.drivable.add(d.outer, true);
      for (const h of d.holes) this.drivable.add(h, true, d.outer);
    }
    for (const p of map.driveways) this.driveways.add(p, true);
    for (const p of map.bumps) this.bumps.add(p, true);
    for (const e of map.edges) this.kerbs.add(e.line.pts);
    for (const l of map.lines) layerOf(this.lines, lineStyle(l.type)).add(l.line.pts);
    this.stripes = map.crosswalks.map(stripeOf);
    this.arrows = findArrows(map);
  }

  private addLane(lane: Lane): void {
    const { pts } = lane.line;
    if (lane.kind === 'walk') this.walks.add(pts);
    else if (lane.kind === 'bike' && !(lane.inside && this.crossesTraffic(lane))) {
      layerOf(this.bike, Math.min(2.4, lane.width)).add(pts);
      this.outlines.add(pts);
    } else if (lane.kind === 'bike') layerOf(this.roads, 2.4).add(pts);
    else {
      // A lane that ends at the map's edge is cut square; between lanes, round ends close the gap.
      const open = !lane.next.length || !lane.prev.length;
      layerOf(open ? this.openRoads : this.roads, this.bandOf(lane)).add(pts);
      this.outlines.add(pts);
    }
  }

  /** If the map has its surface, a lane adds only its own width, so that kerbs stay smooth. */
  private bandOf(lane: Lane): number {
    if (this.map.drivable.length) return lane.width;
    return this.recorded ? BAND_M : Math.max(lane.width + 0.5, 3.2);
  }

  /** Inside a junction a bike lane is unpainted; beside other lanes it is painted. */
  private crossesTraffic(lane: Lane): boolean {
    for (let s = 1; s < lane.line.length; s += 2) {
      const p = pointAt(lane.line, s);
      if (
        nearestLanes(this.map, p.x, p.y, null, 2, (l) => l.kind === 'road').some(
          (h) => Math.abs(Math.sin(h.heading - p.heading)) > 0.4,
        )
      )
        return true;
    }
    return false;
  }

  paint(g: Pen, v: View, showLanes: boolean): void {
    const c = colours();
    const box = v.box(8);
    const px = 1 / v.z;
    g.setTransform(v.dpr, 0, 0, v.dpr, 0, 0);
    g.fillStyle = this.recorded ? c['map-paved'] : c['map-ground'];
    g.fillRect(0, 0, v.w, v.h);
    v.lay(g);
    g.lineJoin = 'round';
    g.lineCap = 'round';
    if (!this.recorded) this.paintSidewalk(g, box, px);
    this.paintSurface(g, box, px);
    this.paintBikeLanes(g, box);
    g.lineCap = 'butt';
    if (v.z > 1.2) this.paintCrosswalks(g, v);
    this.strokeAll(g, this.kerbs, box, c['map-kerb'], Math.max(1.4 * px, 0.24));
    if (v.z >= 2) this.paintLines(g, box, px);
    if (v.z >= 5) this.paintArrows(g, box);
    if (showLanes) this.paintLaneCentres(g, box, px);
  }

  private strokeBands(g: Pen, box: Box, colour: string, extra: number, withBikes = true): void {
    g.lineCap = 'butt';
    for (const [w, layer] of this.openRoads) this.strokeAll(g, layer, box, colour, w + extra);
    if (withBikes) for (const [w, layer] of this.bike) this.strokeAll(g, layer, box, colour, w + extra);
    g.lineCap = 'round';
    for (const [w, layer] of this.roads) this.strokeAll(g, layer, box, colour, w + extra);
  }

  private strokeAll(g: Pen, layer: TileLayer, box: Box, colour: string, width: number, dash: number[] = []): void {
    g.strokeStyle = colour;
    g.lineWidth = width;
    g.setLineDash(dash);
    layer.stroke(g, box);
    if (dash.length) g.setLineDash([]);
  }

  /** Lane maps have no pavements; a broad band beside the carriageway stands for them. */
  private paintSidewalk(g: Pen, box: Box, px: number): void {
    const c = colours();
    const wide = 3.4;
    for (const [extra, colour] of [
      [wide * 2 + 2.4 * px, c['map-grid']],
      [wide * 2, c['map-sidewalk']],
    ] as const) {
      this.strokeBands(g, box, colour, extra);
      this.strokeAll(g, this.walks, box, colour, 3 + extra - wide * 2);
      if (!this.drivable.empty) this.strokeAll(g, this.drivable, box, colour, extra);
    }
  }

  private paintSurface(g: Pen, box: Box, px: number): void {
    const c = colours();
    // Without kerb lines in the map, the edge of a slightly wider band is the kerb.
    if (this.kerbs.empty) {
      const rim = Math.max(2.6 * px, 0.4);
      this.strokeBands(g, box, c['map-kerb'], rim);
      if (!this.drivable.empty) this.strokeAll(g, this.drivable, box, c['map-kerb'], rim);
    }
    g.fillStyle = c['map-asphalt'];
    this.drivable.fill(g, box, 'evenodd');
    this.strokeBands(g, box, c['map-asphalt'], 0, false);
    g.fillStyle = c['map-lot'];
    this.driveways.fill(g, box);
    this.bumps.fill(g, box);
  }

  private paintBikeLanes(g: Pen, box: Box): void {
    g.lineCap = 'butt';
    for (const [w, layer] of this.bike) this.strokeAll(g, layer, box, colours()['map-bike'], w);
    g.lineCap = 'round';
  }

  private paintCrosswalks(g: Pen, v: View): void {
    const c = colours();
    for (const s of this.stripes) {
      const length = Math.hypot(s.b[0] - s.a[0], s.b[1] - s.a[1]);
      const n = Math.max(3, Math.round(length / 1.1));
      g.setLineDash(v.z < 4 ? [] : [length / (2 * n - 1), length / (2 * n - 1)]);
      g.globalAlpha = v.z < 4 ? 0.55 : 1;
      g.strokeStyle = c['map-crosswalk'];
      g.lineWidth = s.width;
      g.beginPath();
      g.moveTo(s.a[0], s.a[1]);
      g.lineTo(s.b[0], s.b[1]);
      g.stroke();
    }
    g.setLineDash([]);
    g.globalAlpha = 1;
  }

  private paintLines(g: Pen, box: Box, px: number): void {
    const c = colours();
    for (const [style, layer] of this.lines) {
      const yellow = style.includes('y');
      const one = Math.max(1 * px, 0.14);
      this.strokeAll(
        g,
        layer,
        box,
        yellow ? c['map-yellow'] : c['map-line'],
        style.includes('2') ? one * 3 : one,
        style.includes('-') ? [3, 4.5] : [],
      );
      // A double line is a broad one with its middle painted over.
      if (style.includes('2')) this.strokeAll(g, layer, box, c['map-asphalt'], one);
    }
  }

  private paintArrows(g: Pen, box: Box): void {
    const c = colours();
    g.strokeStyle = g.fillStyle = c['map-line'];
    g.lineWidth = 0.16;
    for (const a of this.arrows) {
      if (a.x < box.x0 || a.x > box.x1 || a.y < box.y0 || a.y > box.y1) continue;
      g.save();
      g.translate(a.x, a.y);
      g.rotate(a.heading);
      paintArrow(g, a.ways);
      g.restore();
    }
  }

  private paintLaneCentres(g: Pen, box: Box, px: number): void {
    const c = colours();
    g.globalAlpha = 0.75;
    this.strokeAll(g, this.outlines, box, c['line-strong'], 1.1 * px, [6 * px, 5 * px]);
    g.globalAlpha = 1;
  }

  /** True when the map has nothing to show. */
  get empty(): boolean {
    return this.map.lanes.size === 0 && this.map.drivable.length === 0;
  }
}

function layerOf<K>(layers: Map<K, TileLayer>, key: K): TileLayer {
  let l = layers.get(key);
  if (!l) layers.set(key, (l = new TileLayer()));
  return l;
}

/** "y" yellow, "w" white, "2" double, "-" broken. */
function lineStyle(type: string): string {
  return (
    (type.includes('yellow') ? 'y' : 'w') +
    (type.includes('double') ? '2' : '') +
    (type.startsWith('broken') || type.startsWith('passing') ? '-' : '')
  );
}

/** A crosswalk as one broad dashed stroke along its longest side. */
function stripeOf(poly: readonly Vec[]): Stripe {
  let best = 0,
    heading = 0;
  for (let i = 0; i < poly.length; i++) {
    const a = poly[i],
      b = poly[(i + 1) % poly.length];
    const d = Math.hypot(b[0] - a[0], b[1] - a[1]);
    if (d > best) {
      best = d;
      heading = Math.atan2(b[1] - a[1], b[0] - a[0]);
    }
  }
  const c = Math.cos(heading),
    s = Math.sin(heading);
  let u0 = Infinity,
    u1 = -Infinity,
    v0 = Infinity,
    v1 = -Infinity;
  for (const [x, y] of poly) {
    const u = x * c + y * s,
      v = -x * s + y * c;
    u0 = Math.min(u0, u);
    u1 = Math.max(u1, u);
    v0 = Math.min(v0, v);
    v1 = Math.max(v1, v);
  }
  const m = (v0 + v1) / 2;
  const at = (u: number): Vec => [u * c - m * s, u * s + m * c];
  return { a: at(u0), b: at(u1), width: v1 - v0 };
}

/** Turn arrows before a crossing, from the directions of the lane's successors. */
function findArrows(map: LaneMap): Arrow[] {
  const out: Arrow[] = [];
  for (const lane of map.lanes.values()) {
    if (lane.kind !== 'road' || lane.line.length < 18 || lane.type === 'freeway') continue;
    const ways = new Set<string>();
    let junction = lane.next.length > 1;
    for (const id of lane.next) {
      const n = map.lanes.get(id);
      if (!n || n.kind !== 'road') continue;
      const t = wrapAngle(turnOf(n.line));
      if (Math.abs(t) > 0.5) junction = true;
      if (n.inside || n.line.length < 45) ways.add(t > 0.5 ? 'L' : t < -0.5 ? 'R' : 'S');
    }
    if (!junction || !ways.size || !hasNeighbour(map, lane)) continue;
    for (const back of lane.line.length > 40 ? [6, 24] : [6]) {
      const s = lane.line.length - back;
      const p = lane.line.pts,
        S = lane.line.s;
      let i = 1;
      while (i < p.length - 1 && S[i] < s) i++;
      const a = p[i - 1],
        b = p[i],
        k = (s - S[i - 1]) / Math.max(1e-9, S[i] - S[i - 1]);
      out.push({
        x: a[0] + (b[0] - a[0]) * k,
        y: a[1] + (b[1] - a[1]) * k,
        heading: Math.atan2(b[1] - a[1], b[0] - a[0]),
        ways: [...ways].sort().join(''),
      });
    }
  }
  return out;
}

/** Only lanes with neighbours have arrows. */
function hasNeighbour(map: LaneMap, lane: Lane): boolean {
  const p = pointAt(lane.line, lane.line.length - 6);
  return nearestLanes(map, p.x, p.y, p.heading, 5, (l) => l.kind === 'road' && l !== lane).some(
    (h) => h.d > 2 && Math.abs(wrapAngle(h.heading - p.heading)) < 0.3,
  );
}

function paintArrow(g: Pen, ways: string): void {
  const head = (x: number, y: number, turn: number) => {
    g.save();
    g.translate(x, y);
    g.rotate(turn);
    g.beginPath();
    g.moveTo(0.85, 0);
    g.lineTo(0, 0.42);
    g.lineTo(0, -0.42);
    g.fill();
    g.restore();
  };
  g.beginPath();
  g.moveTo(-1.7, 0);
  g.lineTo(ways.includes('S') ? 0.7 : -0.4, 0);
  for (const [way, side] of [
    ['L', 1],
    ['R', -1],
  ] as const) {
    if (!ways.includes(way)) continue;
    g.moveTo(-0.9, 0);
    g.quadraticCurveTo(0.2, 0, 0.3, 0.55 * side);
  }
  g.stroke();
  if (ways.includes('S')) head(0.7, 0, 0);
  if (ways.includes('L')) head(0.3, 0.5, Math.PI / 2);
  if (ways.includes('R')) head(0.3, -0.5, -Math.PI / 2);
}
