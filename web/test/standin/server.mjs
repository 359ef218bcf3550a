// A scripted server for tests and for work on the page: the HTTP interface with constructed answers, and a chosen
// delay, loss and order of events. Not shipped.
//
//   node test/standin/server.mjs [--port 8090] [--delay 8] [--loss 0] [--shuffle] [--judged] [--scene file.json]…
import { createHash } from 'node:crypto';
import { createReadStream, existsSync, readFileSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import { buildCrossing } from './crossing.mjs';
import { giveWay, goOn, reactionTo, sixFutures } from './futures.mjs';
import { byRoad, judged } from './judged.mjs';

const DIST = fileURLToPath(new URL('../../dist', import.meta.url));
/** Delay of every fifth of the others, seconds. */
const LATE_S = 2.2;
const CSP = [
  "default-src 'none'",
  "script-src 'self'",
  "style-src 'self'",
  "img-src 'self' data: blob:",
  "font-src 'self'",
  "connect-src 'self'",
  "worker-src 'self'",
  "base-uri 'none'",
  "form-action 'none'",
  "frame-ancestors 'none'",
].join('; ');
const TYPES = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.svg': 'image/svg+xml',
  '.woff2': 'font/woff2',
  '.txt': 'text/plain',
};

export function startStandIn(options = {}) {
  const o = {
    port: 8090,
    delay: 8,
    loss: 0,
    shuffle: false,
    away: false,
    hang: false,
    busy: 0,
    judged: false,
    scenes: [],
    page: DIST,
    ...options,
  };
  const scenes = new Map();
  const maps = new Map();
  const held = new Map();
  const log = [];
  const seen = new Map();
  const put = (scene, readonly) => {
    const map = scene.map.ref ? maps.get(scene.map.ref) : scene.map;
    const ref = scene.map.ref ?? `sha256:${createHash('sha256').update(JSON.stringify(map)).digest('hex')}`;
    maps.set(ref, map);
    const rev = (scenes.get(scene.id)?.rev ?? 0) + 1;
    scenes.set(scene.id, {
      scene: { ...scene, map },
      ref,
      rev,
      etag: `"${rev}-${createHash('sha256').update(JSON.stringify(scene)).digest('hex').slice(0, 16)}"`,
      readonly,
    });
    return scenes.get(scene.id);
  };
  put(buildCrossing().scene, true);
  put(buildCrossing('demo-crossing-2', 'Second crossing').scene, true);
  for (const file of o.scenes) {
    const s = JSON.parse(readFileSync(file, 'utf8'));
    put({ ...s, id: s.id || file.split('/').pop().replace('.json', '') }, true);
  }

  const problem = (res, status, code, detail, extra = {}) => {
    res.writeHead(status, { 'Content-Type': 'application/problem+json' });
    res.end(JSON.stringify({ code, title: code, detail, status, ...extra }));
  };
  const json = (res, body, headers = {}, status = 200) => {
    res.writeHead(status, { 'Content-Type': 'application/json', 'Cache-Control': 'no-store', ...headers });
    res.end(JSON.stringify(body));
  };
  const body = (req) =>
    new Promise((done) => {
      const parts = [];
      req.on('data', (d) => parts.push(d));
      req.on('end', () => done(Buffer.concat(parts)));
    });
  const sleep = (ms) => new Promise((r) => setTimeout(r, ms));

  async function generate(req, res) {
    const b = JSON.parse((await body(req)).toString());
    if (o.busy > 0) {
      o.busy--;
      return problem(res, 503, 'busy', 'The queue is full.', { retry_after_ms: 50 });
    }
    log.push({ path: 'generate', ...b, scene: b.scene ? 'inline' : undefined });
    const stored = b.scene_id ? (held.get(b.scene_id) ?? scenes.get(b.scene_id)?.scene) : null;
    if (b.scene?.map?.ref && !maps.has(b.scene.map.ref))
      return problem(res, 422, 'unknown-map', 'This map is not known.');
    const scene = stored ?? b.scene;
    if (!scene) return problem(res, 404, 'not-found', 'No such scene.');
    if (b.client) {
      if ((seen.get(b.client) ?? 0) >= b.revision) return problem(res, 409, 'stale-revision', 'Older than the newest.');
      seen.set(b.client, b.revision);
    }
    const name = b.hold && b.scene ? `held:${held.size + 1}` : null;
    if (name) held.set(name, b.scene);
    res.writeHead(200, {
      'Content-Type': 'application/x-ndjson',
      ...(name ? { 'Dragtraffic-Scene': name } : {}),
    });
    const all = scene.agents.filter((a) => a.type !== 'other' && a.track.x_m.length);
    const wanted = b.agents === 'all' ? all : all.filter((a) => b.agents.includes(a.id));
    const reacting =
      b.react === true
        ? all.filter((a) => !wanted.includes(a))
        : Array.isArray(b.react)
          ? all.filter((a) => b.react.includes(a.id))
          : [];
    let seq = 0;
    const began = Date.now();
    const gone = () => res.destroyed || (b.client && seen.get(b.client) > b.revision);
    const send = (e) => {
      if (Math.random() >= o.loss || e.event === 'final')
        res.write(
          `${JSON.stringify({ seq: seq++, job: 'j', revision: b.revision, elapsed_ms: Date.now() - began, ...e })}\n`,
        );
    };
    const six = (a, step) => {
      const modes = sixFutures(a, b.conditions?.[a.id], step, b.steps);
      if (!o.judged || a.type !== 'vehicle') return modes;
      return judged(modes, ['2', '17'], o.collision, b.conditions?.[a.id]?.goal?.may_cross);
    };
    // Pinned ones keep their futures, and the answer omits them.
    const made = wanted.filter((a) => !b.pinned?.includes(a.id));
    const drafts = (step) => Object.fromEntries(made.map((a) => [a.id, { chosen: 0, modes: six(a, step) }]));
    send({
      event: 'accepted',
      regenerated: wanted.map((a) => a.id),
      reacting: reacting.map((a) => a.id),
      warnings: [],
    });
    const order = [...Array(b.steps + 1).keys()];
    const horizon = b.horizon_s ?? 9,
      windows = Math.ceil(horizon / (b.replan_interval_s ?? 9));
    if (o.shuffle) order.sort(() => Math.random() - 0.5);
    for (const step of order) {
      await sleep(o.delay);
      if (gone()) {
        send({ event: 'superseded' });
        res.end();
        return;
      }
      send(
        step === 0
          ? { event: 'initial', window: 0, sample: 0, agents: drafts(0) }
          : { event: 'step', window: 0, sample: 0, step, steps: b.steps, agents: drafts(step) },
      );
    }
    // Later windows continue from the earlier ones; their answers are part of the last event.
    for (let window = 1; window < windows; window++)
      for (const step of order) {
        await sleep(o.delay);
        if (gone()) {
          send({ event: 'superseded' });
          res.end();
          return;
        }
        send({
          event: step ? 'step' : 'initial',
          window,
          sample: 0,
          ...(step ? { step } : {}),
          steps: b.steps,
          agents: {},
        });
      }
    const agents = drafts(b.steps);
    reacting.forEach((a, i) => {
      if (b.conditions?.[a.id]?.goal) {
        agents[a.id] = { chosen: 0, modes: sixFutures(a, b.conditions[a.id], b.steps, b.steps) };
        return;
      }
      const late = i % 5 === 0 ? LATE_S : 0;
      const mode = giveWay(a, late);
      agents[a.id] = { chosen: 0, modes: [mode] };
      if (late && wanted.length) agents[a.id].reaction = reactionTo(wanted[0].id, mode, late);
    });
    if (horizon > 9) for (const f of Object.values(agents)) goOn(f.modes[f.chosen], Math.round(horizon * 10));
    const resolved = {};
    for (const a of wanted) {
      const g = b.conditions?.[a.id]?.goal;
      if (g?.x_m === undefined) continue;
      const d = Math.hypot(g.x_m - a.track.x_m[0], g.y_m - a.track.y_m[0]),
        max = (g.time_s ?? 9) * 14;
      const far = d > max;
      resolved[a.id] = {
        goal: resolvedGoal(g),
        reach: far
          ? {
              status: 'unreachable',
              nearest: {
                x_m: a.track.x_m[0] + ((g.x_m - a.track.x_m[0]) * max) / d,
                y_m: a.track.y_m[0] + ((g.y_m - a.track.y_m[0]) * max) / d,
                heading_rad: g.heading_rad ?? 0,
                speed_mps: 10,
              },
              limiting: 'speed',
              needs: null,
              words: `Too far for ${(g.time_s ?? 9).toFixed(1)} s. The goal is ${d.toFixed(0)} m away.`,
              message: {
                code: 'goal-too-far',
                values: { time_s: g.time_s ?? 9, goal_m: d, start_mps: 5, kind: 'vehicle', most_m: d / 2 },
              },
            }
          : { status: 'reached', position_m: 0, heading_rad: 0, speed_mps: 0 },
        ...(o.judged ? { by_road: byRoad(g) } : {}),
      };
    }
    send({
      event: 'final',
      windows,
      samples: [{ agents }],
      resolved,
      scores: b.score === false ? null : [score()],
      warnings: [],
      timing: {},
    });
    res.end();
  }

  // Close together, and at the very end.
  const crowd = {
    harsh_braking: [
      { agent: '3', time_s: 1.6, until_s: 2, worst: 5.1 },
      { agent: '6', time_s: 1.7, until_s: 1.9, worst: 4.4 },
      { agent: '9', time_s: 9, until_s: 9, worst: 6 },
    ],
    red_lights: [{ agent: '5', lane: 'x_in21_out01', time_s: 1.9, speed_mps: 8.6 }],
  };

  const score = () => ({
    scene: {
      collisions: o.collision ? [{ a: '1', b: '2', time_s: 5.4, iou: 0.1 }] : [],
      near_misses: [
        { a: '11', b: '14', time_s: 3.2, distance_m: 0.6, ttc_s: 1.1 },
        ...(o.judged ? [{ a: '19', b: '20', time_s: 1.4, distance_m: 0.4, ttc_s: null, in_log: true }] : []),
      ],
      ...(o.judged ? crowd : {}),
      min_ttc_s: 1.1,
      offroad_share: null,
    },
    agents: {},
  });

  async function api(req, res, url) {
    const m = /^\/v1\/scenes\/([\w-]+)(\/export|\/preview)?$/.exec(url.pathname);
    if (url.pathname === '/v1/scenes' && req.method === 'GET')
      return json(res, {
        scenes: [...scenes.values()].map((s) => ({
          id: s.scene.id,
          name: s.scene.name,
          etag: s.etag,
          counts: countOf(s.scene),
          map_sha256: s.ref.slice(7),
          source: s.scene.meta?.source,
          readonly: s.readonly,
        })),
        next: null,
      });
    if (url.pathname === '/v1/scenes' && req.method === 'POST') {
      const s = JSON.parse((await body(req)).toString());
      const id = `own-${scenes.size}`;
      const k = put({ ...s, id }, false);
      return json(res, { id }, { ETag: k.etag, Location: `/v1/scenes/${id}` }, 201);
    }
    if (m && req.method === 'GET') {
      const s = scenes.get(m[1]);
      if (!s) return problem(res, 404, 'not-found', 'No such scene.');
      return json(
        res,
        { ...s.scene, map: url.searchParams.get('map') === 'ref' ? { ref: s.ref } : s.scene.map },
        { ETag: s.etag },
      );
    }
    if (m && req.method === 'PUT') {
      const s = scenes.get(m[1]);
      if (s && req.headers['if-match'] !== s.etag)
        return problem(res, 412, 'stale-etag', 'Changed meanwhile.', { etag: s.etag });
      const k = put({ ...JSON.parse((await body(req)).toString()), id: m[1] }, false);
      return json(res, {}, { ETag: k.etag });
    }
    if (m && req.method === 'DELETE') {
      scenes.delete(m[1]);
      res.writeHead(204);
      return res.end();
    }
    if (url.pathname === '/v1/generate') return generate(req, res);
    if (url.pathname === '/v1/score') {
      await body(req);
      return json(res, { ...score(), scene: { ...score().scene, collisions: [], near_misses: [], min_ttc_s: null } });
    }
    if (url.pathname === '/v1/import') {
      const text = (await body(req)).toString();
      try {
        const s = JSON.parse(text);
        if (!s.agents) throw 0;
        const id = `import-${scenes.size}`;
        put({ ...s, id, name: s.name ?? 'Imported' }, false);
        return json(
          res,
          { scenes: [{ id, name: s.name ?? 'Imported', warnings: [], counts: countOf(s) }], skipped: [] },
          {},
          201,
        );
      } catch {
        return problem(res, 422, 'format-unknown', 'Not a scene.');
      }
    }
    if (url.pathname === '/v1/export') {
      res.writeHead(200, {
        'Content-Type': 'application/octet-stream',
        'Content-Disposition': 'attachment; filename="out.json"',
      });
      return res.end(await body(req));
    }
    return problem(res, 404, 'not-found', 'Nothing here.');
  }

  const countOf = (s) => {
    const c = { vehicle: 0, pedestrian: 0, cyclist: 0, other: 0 };
    for (const a of s.agents) c[a.type]++;
    return c;
  };

  const server = createServer((req, res) => {
    const url = new URL(req.url, 'http://x');
    if (o.away) return void req.socket.destroy();
    // Accepts the question without an answer, like a stopped process.
    if (o.hang && ['/v1/generate', '/healthz'].includes(url.pathname)) return;
    if (url.pathname === '/healthz') return void res.end('ok');
    if (url.pathname.startsWith('/v1/'))
      return void api(req, res, url).catch((e) => problem(res, 500, 'internal', String(e)));
    let file = normalize(join(o.page, url.pathname));
    if (!file.startsWith(o.page) || !existsSync(file) || statSync(file).isDirectory())
      file = join(o.page, 'index.html');
    res.writeHead(200, {
      'Content-Type': TYPES[extname(file)] ?? 'application/octet-stream',
      'Content-Security-Policy': CSP,
    });
    createReadStream(file).pipe(res);
  });
  return new Promise((done) =>
    server.listen(o.port, '127.0.0.1', () =>
      done({
        url: `http://127.0.0.1:${server.address().port}`,
        options: o,
        log,
        /** Scenes that came with questions are dropped. */
        forget: () => held.clear(),
        scenes,
        close: () =>
          new Promise((r) => {
            server.closeAllConnections();
            server.close(r);
          }),
      }),
    ),
  );
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const arg = (name, fallback) => {
    const i = process.argv.indexOf(`--${name}`);
    return i < 0 ? fallback : process.argv[i + 1];
  };
  const scenes = process.argv.flatMap((v, i, all) => (all[i - 1] === '--scene' ? [v] : []));
  const s = await startStandIn({
    port: Number(arg('port', 8090)),
    delay: Number(arg('delay', 8)),
    loss: Number(arg('loss', 0)),
    shuffle: process.argv.includes('--shuffle'),
    collision: process.argv.includes('--collision'),
    judged: process.argv.includes('--judged'),
    scenes,
  });
  console.log(`stand-in on ${s.url}`);
}

/** The fields of a goal as they were used; free ones by the model. */
function resolvedGoal(g) {
  const field = (value, free) => ({ value: value ?? free, from: value === undefined ? 'model' : 'user' });
  return {
    x_m: field(g.x_m, 0),
    y_m: field(g.y_m, 0),
    heading_rad: field(g.heading_rad, 0),
    speed_mps: field(g.speed_mps, 5),
    time_s: field(g.time_s, 9),
  };
}
