// Made-up facts of a generator about its futures: four drive over a median, one of them into another road user, one
// reaches the goal by the road, the last one stops short.

const fault = (kind, mode, from, to, extra = {}) => {
  const i = Math.min(mode.x_m.length - 1, Math.round(((from + to) / 2) * 10) - 1);
  return { kind, time_s: from, until_s: to, x_m: mode.x_m[i], y_m: mode.y_m[i], ...extra };
};
const relation = (kind, other, mode, time) => {
  const i = Math.min(mode.x_m.length - 1, Math.round(time * 10) - 1);
  return { kind, with: other, time_s: time, x_m: mode.x_m[i], y_m: mode.y_m[i], gap_s: 1.4 };
};

/** The road edge that they cross. */
export const MEDIAN = 'm0';

/** The same six with faults, relations and manoeuvres; `others` are the ids of the met road users. */
export function judged(modes, [first, second], hit = false, mayCross = []) {
  const over = (m, from) =>
    mayCross.includes(MEDIAN) ? [] : [fault('over_median', m, from, from + 1.1, { extent: 0.6, edge: MEDIAN })];
  const said = [
    (m) => ({
      faults: [...(hit ? [fault('collision', m, 5.4, 5.6, { extent: 4, with: first })] : []), ...over(m, 3.2)],
      relations: [relation('before', first, m, 4.1)],
      manoeuvre: 'left',
    }),
    (m) => ({ faults: over(m, 3.1), relations: [relation('after', first, m, 4.8)], manoeuvre: 'left' }),
    (m) => ({ faults: over(m, 3.3), relations: [relation('gives_way_to', second, m, 5)], manoeuvre: 'left' }),
    (m) => ({
      faults: [...over(m, 3.2), fault('harsh_braking', m, 6.8, 7.6, { extent: 6.2 })],
      relations: [relation('after', first, m, 5.2)],
      manoeuvre: 'left',
    }),
    () => ({ manoeuvre: 'left' }),
    (m) => ({ faults: [fault('goal_missed', m, 9, 9, { extent: 14 })], manoeuvre: 'straight' }),
  ];
  return modes.map((m, i) => ({ ...m, anchor: i, ...said[i % said.length](m) }));
}

/** The nearest goal by the road, some way beyond the requested one. */
export const byRoad = (goal) => ({
  x_m: goal.x_m + 14 * Math.cos(goal.heading_rad ?? 0),
  y_m: goal.y_m + 14 * Math.sin(goal.heading_rad ?? 0),
  heading_rad: goal.heading_rad ?? 0,
  distance_m: 14,
});
