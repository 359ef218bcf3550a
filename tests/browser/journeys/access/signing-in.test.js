// A server with a token: the page asks for it once, and everything works by the cookie. So it does below a path.
import assert from 'node:assert/strict';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { it } from 'node:test';
import { carOnTheMove } from '../../support/casting.js';
import { journeys } from '../../support/journey.js';
import { Program } from '../../support/program.js';
import { freePort, nginx, Proxy } from '../../support/proxy.js';

const TOKEN = '0123456789abcdef+0123456789abcdef';

journeys('signing in', (stage) => {
  const skip = !nginx() && 'no nginx here; install it (Debian: apt-get install nginx-light) or set NGINX';
  it('works below the path at which nginx publishes the server', { skip, timeout: 60_000 }, async () => {
    const folder = mkdtempSync(join(tmpdir(), 'dragtraffic-path-'));
    const file = join(folder, 'token');
    writeFileSync(file, TOKEN, { mode: 0o600 });
    const port = await freePort();
    const behind = ['--trust-proxy', '127.0.0.1', '--allow-host', `127.0.0.1:${port}`];
    const program = await Program.start(undefined, ['--base-path', '/tools/drag', '--token-file', file, ...behind]);
    const proxy = await Proxy.start(program.url, port);
    try {
      const place = new URL('/tools/drag/scenes/demo-crossing', proxy.url);
      const e = await stage.visit(place.href, { scene: false });
      const lines = [];
      e.page.on('websocket', (line) => lines.push(line.url()));
      await e.page.getByLabel('Token').fill(TOKEN);
      await e.page.getByRole('button', { name: 'Sign in' }).click();
      await e.ready();
      await e.begin();
      assert.equal(new URL(e.page.url()).pathname, place.pathname);
      const car = await carOnTheMove(e);
      await e.choose(car.id);
      await e.page.waitForSelector('.fu');
      // The futures come by the open line, through the proxy.
      assert.ok(lines.length > 0 && lines.every((url) => url.startsWith(proxy.url.replace('http', 'ws'))), `${lines}`);
      const [cookie] = await e.page.context().cookies();
      assert.equal(cookie.path.replace(/\/$/, ''), '/tools/drag');
    } finally {
      await proxy.stop();
      await program.stop();
      rmSync(folder, { recursive: true, force: true });
    }
  });

  it('asks for the token, refuses another one, and then edits as always', { timeout: 60_000 }, async () => {
    const folder = mkdtempSync(join(tmpdir(), 'dragtraffic-token-'));
    const file = join(folder, 'token');
    writeFileSync(file, TOKEN, { mode: 0o600 });
    const program = await Program.start(undefined, ['--token-file', file]);
    try {
      const e = await stage.visit(new URL('/scenes/demo-crossing', program.url).href, { scene: false });
      const enter = async (token) => {
        await e.page.getByLabel('Token').fill(token);
        await e.page.getByRole('button', { name: 'Sign in' }).click();
      };
      await e.page.getByRole('heading', { name: 'This server needs a token' }).waitFor();
      await enter(`${TOKEN}x`);
      await e.page.getByText('That is not a token of this server.').waitFor();
      await e.picture('sign-in');
      await enter(TOKEN);
      await e.ready();
      await e.begin();
      assert.equal(new URL(e.page.url()).pathname, '/scenes/demo-crossing');
      const car = await carOnTheMove(e);
      await e.choose(car.id);
      await e.page.waitForSelector('.fu');
      await e.page.reload();
      await e.ready();
      assert.deepEqual(
        (await e.page.context().cookies()).map(({ httpOnly, sameSite }) => ({ httpOnly, sameSite })),
        [{ httpOnly: true, sameSite: 'Strict' }],
      );
    } finally {
      await program.stop();
      rmSync(folder, { recursive: true, force: true });
    }
  });
});
