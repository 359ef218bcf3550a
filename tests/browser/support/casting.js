// Finds road users for a role, by the page's texts about them. Scenes may change; the roles stay.
import { distance, turn } from './editor.js';

async function look(e, u) {
  const start = await e.pose('Start'),
    end = await e.pose('Goal');
  return { ...u, start, end, from: await e.at(start.x, start.y), to: await e.at(end.x, end.y) };
}

/** Are the box and the flag of a road user in view, without a panel over them? */
const clear = async (e, who) => (await e.open(who.from)) && (await e.open([who.to[0] + 9, who.to[1] - 26]));

/**
 * Tries the likely ones and takes the first that `suits`, in view if possible; else the view is moved to the first that
 * suits. No road user is selected afterwards.
 */
async function find(e, likely, suits) {
  const tried = [],
    hidden = [];
  for (const u of likely) {
    await e.choose(u.id);
    const who = await look(e, u);
    const why = suits(who);
    const seen = why === true && (await clear(e, who));
    await e.letGo();
    // The picture may return to where it was before the curves took room.
    const { start, end } = who;
    if (seen) return { ...who, from: await e.at(start.x, start.y), to: await e.at(end.x, end.y) };
    if (why === true) hidden.push(u);
    else tried.push(`${u.name} ${why}`);
  }
  for (const u of hidden) {
    await e.choose(u.id);
    await e.key('z');
    await e.settled();
    const who = await look(e, u);
    const seen = await clear(e, who);
    await e.letGo();
    if (seen) return who;
    tried.push(`${u.name} is under a panel`);
  }
  throw new Error(`nobody fits: ${tried.join(', ')}`);
}

/** A car that continues for a good distance without turning off. */
export async function carOnTheMove(e) {
  const cars = (await e.roadUsers()).filter((u) => u.kind === 'Car' && u.speed > 2.5).sort((a, b) => b.speed - a.speed);
  return find(e, cars, (who) => {
    const far = distance(who.start, who.end);
    if (far < 15 || far > 95) return `goes ${far.toFixed(0)} m`;
    return turn(who.start.heading, who.end.heading) < 0.2 || 'turns';
  });
}

/** Clicks a car on the move, and waits for its futures. */
export async function selectMovingCar(e) {
  const car = await carOnTheMove(e);
  await e.page.mouse.click(...car.from);
  await e.page.waitForSelector('.fu');
  await e.settled();
  return car;
}

export async function pedestrianOnTheMove(e) {
  return find(
    e,
    (await e.roadUsers()).filter((u) => u.kind === 'Pedestrian' && u.speed > 0.7),
    () => true,
  );
}

export async function cyclistOnTheMove(e) {
  return find(
    e,
    (await e.roadUsers()).filter((u) => u.kind === 'Cyclist' && u.speed > 1.5),
    () => true,
  );
}

/** A moving car, and a vehicle ahead of it, near enough for a collision. */
export async function carBehindAnother(e) {
  const vehicles = [];
  for (const u of (await e.roadUsers()).filter(
    (u) => ['Car', 'Bus', 'Truck'].includes(u.kind) && !u.words.includes('parked'),
  )) {
    await e.choose(u.id);
    vehicles.push(await look(e, u));
    await e.letGo();
  }
  const ahead = (car, who) => {
    const far = distance(car.start, who.start);
    const bearing = Math.atan2(who.start.y - car.start.y, who.start.x - car.start.x);
    return far > 12 && far < 70 && turn(bearing, car.start.heading) < 0.6;
  };
  for (const car of vehicles.filter((u) => u.kind === 'Car' && u.speed > 2.5)) {
    const obstacle = vehicles.find((who) => who.id !== car.id && ahead(car, who));
    if (obstacle) return { car, obstacle };
  }
  throw new Error('nobody drives behind anybody');
}

/** The open scene, as the server has it. */
async function openScene(e) {
  const name = await e.page.locator('.title input').inputValue();
  const get = async (path) => (await e.page.request.get(new URL(path, e.page.url()).href)).json();
  const { scenes } = await get('/v1/scenes');
  return get(`/v1/scenes/${scenes.find((s) => s.name === name).id}`);
}

/** Distance of a place across a median, and of a goal beside it, metres. */
const ACROSS_M = 5,
  BESIDE_M = 6;

/** The place straight across a median from a road user's end; null where there is none. */
function acrossMedian(medians, { end }) {
  const left = { x: -Math.sin(end.heading), y: Math.cos(end.heading) };
  const aside = (p) => (p[0] - end.x) * left.x + (p[1] - end.y) * left.y;
  const along = (p) => (p[0] - end.x) * left.y - (p[1] - end.y) * left.x;
  for (const line of medians) {
    const all = line.map(along);
    // Well inside the median, or the way round its end would be no detour.
    if (Math.max(...all) < 15 || Math.min(...all) > -15) continue;
    const at = line.findIndex((_, i) => i > 0 && all[i - 1] * all[i] <= 0);
    const side = (aside(line[at - 1]) + aside(line[at])) / 2;
    if (Math.abs(side) > BESIDE_M) continue;
    const d = side + Math.sign(side) * ACROSS_M;
    return { x: end.x + left.x * d, y: end.y + left.y * d };
  }
  return null;
}

/** A moving car that ends beside a median, and a place straight across it. */
export async function carBesideMedian(e) {
  const { map } = await openScene(e);
  const medians = map.road_edges.filter((r) => r.type === 'median').map((r) => r.points_m);
  const cars = (await e.roadUsers()).filter((u) => u.kind === 'Car' && u.speed > 2.5);
  const car = await find(
    e,
    cars,
    (who) =>
      (distance(who.start, who.end) > 40 && acrossMedian(medians, who) !== null) ||
      'does not end far off, beside a median',
  );
  return { car, across: acrossMedian(medians, car) };
}

/** A moving car with its box and flag in the current picture, apart from each other, without a panel over them. */
export async function carInSight(e) {
  const cars = (await e.roadUsers()).filter((u) => u.kind === 'Car' && u.speed > 2.5);
  const seen = [];
  for (const u of cars) {
    await e.choose(u.id);
    const { cx, cy } = await e.view();
    const who = await look(e, u);
    const far = distance(who.start, who.end);
    // Moving the picture to it does not count.
    if (far > 20 && (await clear(e, who))) {
      await e.letGo();
      const after = await e.view();
      if (after.cx === cx && after.cy === cy) return who;
    } else await e.letGo();
    seen.push(`${u.name} ${far.toFixed(0)} m`);
  }
  throw new Error(`nobody is in sight: ${seen.join(', ')}`);
}
