// Calls by a generated client; each prints whether it got what the document says.
import createClient from 'openapi-fetch';
import type { components, paths } from './api.js';

declare const process: { argv: string[] };

const [address, file] = process.argv.slice(2);
const client = createClient<paths>({ baseUrl: address.replace(/\/$/, '') });
const { readFile } = await import('node:fs/promises' as string);
const scene: components['schemas']['Scene'] = JSON.parse(await readFile(file, 'utf8'));

const check = (name: string, holds: boolean) => console.log(holds ? 'ok' : 'failed', name);

const info = await client.GET('/v1/info');
check('information', info.data?.version === '0.1.0');
const saved = await client.POST('/v1/scenes', { body: scene });
check('saved', saved.data !== undefined);
const id = saved.data!.id;
const listed = await client.GET('/v1/scenes', { params: { query: { limit: 200 } } });
check('listed', listed.data!.scenes.some((item) => item.id === id));
const read = await client.GET('/v1/scenes/{id}', { params: { path: { id } } });
check('read', read.data!.agents!.length === scene.agents!.length);
const asked = { scene_id: id, agents: ['5'], conditions: { 5: { goal: { x_m: 14, y_m: 0.4 } } } };
const { data: answer } = await client.POST('/v1/generate', {
  body: asked,
  headers: { accept: 'application/json' },
});
const future = answer?.event === 'final' && answer.samples[0].agents['5'];
check('futures', future && 'modes' in future && future.modes.length === 6);
const score = await client.POST('/v1/score', { body: { scene_id: id } });
check('scored', Object.keys(score.data!.agents).length === scene.agents!.length);
const placed = await client.POST('/v1/place', { body: { scene_id: id, density: { count: 5 }, keep: [] } });
check('placed', placed.data!.agents.length === 5);
const map = await client.POST('/v1/map', { body: { template: 'roundabout' } });
const drawn = map.data!.scene.map;
check('a map', 'lanes' in drawn && drawn.lanes!.length > 4);
const run = await client.POST('/v1/runs', { body: { scene_id: id } });
check('a run', run.data !== undefined);
const path = { id: run.data!.run };
const step = await client.POST('/v1/runs/{id}/step', { params: { path }, body: { number: 1 } });
check('a step', step.data!.number === 1);
check('a run ends', (await client.DELETE('/v1/runs/{id}', { params: { path } })).response.status === 204);
const written = await client.GET('/v1/scenes/{id}/export', {
  params: { path: { id }, query: { format: 'csv' } },
  parseAs: 'text',
});
check('exported', written.response.ok && String(written.data).includes(','));
const gone = await client.DELETE('/v1/scenes/{id}', {
  params: { path: { id }, header: { 'If-Match': saved.data!.etag } },
});
check('deleted', gone.response.status === 204);
const missing = await client.GET('/v1/scenes/{id}', { params: { path: { id } } });
check('a problem has its code', missing.error?.code === 'not-found');
