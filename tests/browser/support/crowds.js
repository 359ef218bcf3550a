// Scenes with many road users, made by the program itself: an example with further ones placed on its map, each with
// the motion that the program generates.

const DEMO = 'demo-arterial';
/** Road users computed in one call. */
const AT_ONCE = 60;
/** Road users placed beyond those that are needed. */
const SPARE = 30;

async function asked(url, path, body) {
  const reply = await fetch(new URL(path, url), {
    method: 'POST',
    headers: { 'Content-Type': 'application/json', Accept: 'application/json' },
    body: JSON.stringify(body),
  });
  if (!reply.ok) throw new Error(`${path}: ${reply.status} ${(await reply.text()).slice(0, 300)}`);
  return reply.json();
}

/** Stores a scene of this many road users, each with its own motion; returns its id. */
export async function crowd(url, count) {
  const scene = await (await fetch(new URL(`/v1/scenes/${DEMO}`, url))).json();
  const missing = count - scene.agents.length;
  // Some kinds may find no place.
  const placed = await asked(url, '/v1/place', {
    scene_id: DEMO,
    density: { count: missing + SPARE },
    seed: 1,
    min_gap_m: 1,
  });
  const agents = placed.agents.slice(0, missing);
  if (agents.length < missing) throw new Error(`only ${agents.length} of ${missing} found a place`);
  scene.agents.push(...agents);
  for (let i = 0; i < agents.length; i += AT_ONCE) {
    const some = agents.slice(i, i + AT_ONCE);
    const reply = await asked(url, '/v1/generate', {
      scene,
      agents: some.map((a) => a.id),
      react: false,
      modes: 1,
      steps: 0,
    });
    for (const a of some) recorded(a, reply.samples[0].agents[a.id].modes[0], scene.time);
  }
  const kept = await asked(url, '/v1/scenes', { ...scene, id: null, name: `Crowd of ${count}` });
  return kept.id;
}

/** The generated motion of a road user becomes its recording. */
function recorded(agent, mode, { steps }) {
  const { track } = agent;
  const before = track.first_step + track.x_m.length;
  const most = steps - before;
  for (const name of ['x_m', 'y_m', 'heading_rad', 'vx_mps', 'vy_mps'])
    track[name] = [...track[name], ...mode[name].slice(0, most)];
  track.valid = [[track.first_step, track.first_step + track.x_m.length]];
  delete agent.conditions;
}
