// Finds road users fit for a part, by what the page says about them. Scenes may change; the parts stay.
import { distance, turn } from './editor.js';

/** Goes through the list and keeps the first that `fits`; with nobody selected again at the end. */
async function find(e, likely, fits) {
  const tried = [];
  for (const u of likely) {
    await e.choose(u.id);
    const start = await e.pose('Start'), end = await e.pose('Goal');
    const who = { ...u, start, end, from: await e.at(start.x, start.y), to: await e.at(end.x, end.y) };
    const why = await fits(who);
    await e.letGo();
    if (why === true) return who;
    tried.push(`${u.name}: ${why}`);
  }
  throw new Error(`nobody fits. ${tried.join('; ')}`);
}

const clear = async (e, who) => (!(await e.open(who.from)) ? 'starts under a panel' : !(await e.open([who.to[0] + 9, who.to[1] - 26])) ? 'ends under a panel' : true);

/** A car that goes straight on for a good distance, all in view. */
export async function carOnTheMove(e) {
  const cars = (await e.roadUsers()).filter((u) => u.kind === 'Car' && u.speed > 2.5).sort((a, b) => b.speed - a.speed);
  return find(e, cars, async (who) => {
    const far = distance(who.start, who.end);
    if (far < 20 || far > 110) return `goes ${far.toFixed(0)} m`;
    if (turn(who.start.heading, who.end.heading) > 0.2) return 'turns';
    return clear(e, who);
  });
}

export async function pedestrianOnTheMove(e) {
  const people = (await e.roadUsers()).filter((u) => u.kind === 'Pedestrian' && u.speed > 0.7);
  return find(e, people, (who) => clear(e, who));
}

export async function cyclistOnTheMove(e) {
  const riders = (await e.roadUsers()).filter((u) => u.kind === 'Cyclist' && u.speed > 1.5);
  return find(e, riders, (who) => clear(e, who));
}

/** A vehicle that stands or drives ahead of another one, near enough to be run into. */
export async function inTheWayOf(e, car) {
  const others = (await e.roadUsers()).filter((u) => u.id !== car.id && ['Car', 'Bus', 'Truck'].includes(u.kind) && !u.words.includes('parked'));
  return find(e, others, async (who) => {
    const far = distance(car.start, who.start);
    const bearing = Math.atan2(who.start.y - car.start.y, who.start.x - car.start.x);
    if (far < 12 || far > 70) return `${far.toFixed(0)} m away`;
    return turn(bearing, car.start.heading) < 0.6 || 'not ahead';
  });
}
