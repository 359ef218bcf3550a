// The real program on a separate database.
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { program, running } from './where.js';

const STARTS_WITHIN_MS = 20_000;
const ENDS_WITHIN_MS = 5_000;

export class Program {
  #folder = mkdtempSync(join(tmpdir(), 'dragtraffic-journeys-'));
  #child = null;
  #bin = program;
  #options = [];
  url = '';

  /** `bin`: another program than the built one; `options` of `serve`. */
  static async start(bin = program, options = []) {
    const p = new Program();
    p.#bin = bin;
    p.#options = options;
    if (running) p.url = running;
    else await p.run();
    return p;
  }

  /** Starts, or starts again on the same port and database. */
  async run() {
    const port = this.url ? new URL(this.url).port : '0';
    const child = spawn(
      this.#bin,
      ['serve', '--port', port, '--db', join(this.#folder, 'scenes.sqlite'), '--log-level', 'warn', ...this.#options],
      {
        stdio: ['ignore', 'pipe', 'pipe'],
        env: Object.fromEntries(Object.entries(process.env).filter(([name]) => !name.startsWith('DRAGTRAFFIC_'))),
      },
    );
    this.#child = child;
    let said = '';
    child.stderr.on('data', (text) => {
      said += text;
    });
    this.url = await new Promise((resolve, reject) => {
      const late = setTimeout(() => reject(new Error(`the program did not start in time: ${said}`)), STARTS_WITHIN_MS);
      child.once('exit', (code) => reject(new Error(`the program ended with ${code}: ${said}`)));
      child.stdout.on('data', (text) => {
        const url = /http:\/\/\S+/.exec(text)?.[0];
        if (!url) return;
        clearTimeout(late);
        resolve(url);
      });
    });
  }

  /** Ends at once, as a crash or a power cut would. */
  async kill() {
    await this.#end('SIGKILL');
  }

  async stop() {
    await this.#end('SIGTERM');
    rmSync(this.#folder, { recursive: true, force: true });
  }

  async #end(signal) {
    const child = this.#child;
    if (!child || child.exitCode !== null || child.signalCode !== null) return;
    const gone = new Promise((resolve) => child.once('exit', resolve));
    child.kill(signal);
    const late = setTimeout(() => child.kill('SIGKILL'), ENDS_WITHIN_MS);
    await gone;
    clearTimeout(late);
  }
}
