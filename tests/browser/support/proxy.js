// nginx before a server, with the site of docs/hosting.md.
import { spawn } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { connect, createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { setTimeout as after } from 'node:timers/promises';

/** Place of nginx, or null; one that its variable names has to be there. */
export function nginx() {
  const given = process.env.NGINX;
  if (given && !existsSync(given)) throw new Error(`NGINX is ${given}, and there is no such program.`);
  return given || ['/usr/sbin/nginx', '/usr/bin/nginx'].find((path) => existsSync(path)) || null;
}

/** A port of this machine that nobody listens at. */
export function freePort() {
  const held = createServer();
  return new Promise((resolve) =>
    held.listen(0, '127.0.0.1', () => {
      const { port } = held.address();
      held.close(() => resolve(port));
    }),
  );
}

/** A proxy on a port of this machine, without TLS. */
export class Proxy {
  #folder = mkdtempSync(join(tmpdir(), 'dragtraffic-proxy-'));
  #child = null;
  url = '';

  /** `server`: address of the server that it stands before; `port`: its own, which that server must allow as a host. */
  static async start(server, port) {
    const proxy = new Proxy();
    await proxy.#run(new URL(server).host, port);
    return proxy;
  }

  async #run(server, port) {
    const at = (name) => join(this.#folder, name);
    const site = readFileSync(new URL('../../../deploy/nginx.conf', import.meta.url), 'utf8')
      .replace('listen 443 ssl;', `listen 127.0.0.1:${port};`)
      .replace(/^\s*ssl_certificate.*$/gm, '')
      .replace('http://unix:/run/dragtraffic/drag.sock', `http://${server}`)
      // The name that a browser sends has a port, since this one is not that of https.
      .replace('proxy_set_header Host $host;', 'proxy_set_header Host $http_host;');
    const places = ['client_body', 'proxy', 'fastcgi', 'uwsgi', 'scgi'];
    const temporary = places.map((name) => `${name}_temp_path ${at(name)};\n`).join('');
    const user = process.getuid() === 0 ? 'user root;\n' : '';
    writeFileSync(
      at('nginx.conf'),
      `${user}daemon off;\npid ${at('nginx.pid')};\nevents {}\nhttp {\naccess_log off;\n${temporary}${site}}\n`,
    );
    const child = spawn(nginx(), ['-p', this.#folder, '-e', at('error.log'), '-c', at('nginx.conf')], {
      stdio: 'ignore',
    });
    this.#child = child;
    for (let tries = 0; tries < 200 && !(await answers(port)); tries++) {
      if (child.exitCode !== null) throw new Error(`nginx ended: ${readFileSync(at('error.log'), 'utf8')}`);
      await after(50);
    }
    this.url = `http://127.0.0.1:${port}/`;
  }

  async stop() {
    const child = this.#child;
    const gone = new Promise((resolve) => child.once('exit', resolve));
    if (child.exitCode === null) {
      child.kill('SIGTERM');
      await gone;
    }
    rmSync(this.#folder, { recursive: true, force: true });
  }
}

function answers(port) {
  return new Promise((resolve) => {
    const line = connect(port, '127.0.0.1');
    line.once('connect', () => {
      line.destroy();
      resolve(true);
    });
    line.once('error', () => resolve(false));
  });
}
