import type { ClientRequest } from 'node:http';
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { brotliCompressSync, constants, gzipSync } from 'node:zlib';
import type { Plugin, ProxyOptions } from 'vite';
import { defineConfig } from 'vitest/config';
import { shortKeys } from './tools/short-keys.ts';

// The server refuses requests whose Origin is not its own address; behind this proxy there is none.
const SERVER: ProxyOptions = {
  target: process.env.DRAGTRAFFIC_URL ?? 'http://127.0.0.1:8080',
  changeOrigin: true,
  ws: true,
  configure: (proxy) => {
    for (const sent of ['proxyReq', 'proxyReqWs'] as const)
      proxy.on(sent, (request: ClientRequest) => request.removeHeader('origin'));
  },
};

/** Texts of the build lie there compressed too: the server sends them as they are. */
function packed(): Plugin {
  const brotli = { params: { [constants.BROTLI_PARAM_QUALITY]: constants.BROTLI_MAX_QUALITY } };
  let folder = '';
  return {
    name: 'packed',
    apply: 'build',
    configResolved: (config) => void (folder = config.build.outDir),
    writeBundle: (options) => {
      const root = options.dir ?? folder;
      for (const name of readdirSync(root, { recursive: true, encoding: 'utf8' })) {
        if (!/\.(js|css|html|svg|txt)$/.test(name)) continue;
        const text = readFileSync(join(root, name));
        writeFileSync(join(root, `${name}.br`), brotliCompressSync(text, brotli));
        writeFileSync(join(root, `${name}.gz`), gzipSync(text, { level: 9 }));
      }
    },
  };
}

/** The most that scripts may weigh, in KB (1000 bytes) as gzip: what comes first, and what comes after it at once. */
const MOST_KB = { first: 80.3, desk: 128.3 };

/** A build whose first scripts weigh more than they may fails. */
function weighed(): Plugin {
  return {
    name: 'weighed',
    apply: 'build',
    generateBundle(_, bundle) {
      const chunks = Object.values(bundle).filter((c) => c.type === 'chunk');
      /** A script with all that it needs to start. */
      const withImports = (name: string, all = new Set<string>()): Set<string> => {
        const chunk = chunks.find((c) => c.fileName === name);
        if (!chunk || all.has(name)) return all;
        all.add(name);
        for (const i of chunk.imports) withImports(i, all);
        return all;
      };
      const from = (module: string): Set<string> => {
        const chunk = chunks.find((c) => (c.facadeModuleId ?? '').endsWith(module));
        if (!chunk) this.error(`no script is made of ${module}`);
        return withImports(chunk!.fileName);
      };
      const kb = (names: Iterable<string>): number =>
        [...names].reduce(
          (sum, n) => sum + gzipSync(chunks.find((c) => c.fileName === n)!.code, { level: 9 }).length,
          0,
        ) / 1000;
      const first = from('/index.html');
      const weights = { first: kb(first), desk: kb([...from('/app/desk.ts')].filter((n) => !first.has(n))) };
      for (const [name, kilobytes] of Object.entries(weights)) {
        const most = MOST_KB[name as keyof typeof MOST_KB];
        const words = `scripts, ${name}: ${kilobytes.toFixed(1)} KB gzip of ${most}`;
        if (kilobytes > most) this.error(`${words}. Load what is not needed so early later (src/app/later.tsx).`);
        this.info(words);
      }
    },
  };
}

/** What loads as one script each: there are few of them to wait for, and they pack better than many small ones. */
const WHOLE = { first: '/app/main.ts', desk: '/app/desk.ts' };

/** Which script a module that is needed at once goes into, by what is imported from where. */
const scriptOf = new Map<string, string>();
function wholes(): Plugin {
  return {
    name: 'wholes',
    apply: 'build',
    buildEnd() {
      scriptOf.clear();
      const take = (id: string, script: string): void => {
        if (scriptOf.has(id)) return;
        scriptOf.set(id, script);
        for (const next of this.getModuleInfo(id)?.importedIds ?? []) take(next, script);
      };
      for (const [script, module] of Object.entries(WHOLE))
        for (const id of this.getModuleIds()) if (id.endsWith(module)) take(id, script);
    },
  };
}

// The production build is embedded into the server binary, so every asset has a hashed name and
// nothing is inlined into the page: the server's content security policy refuses inline code.
export default defineConfig({
  base: '/',
  // Scripts find each other by their own place, so that a proxy can publish the server below a path.
  experimental: { renderBuiltUrl: (_, { hostType }) => (hostType === 'html' ? undefined : { relative: true }) },
  plugins: [shortKeys(), wholes(), weighed(), packed()],
  build: {
    outDir: 'dist',
    assetsInlineLimit: 0,
    target: 'es2022',
    modulePreload: { polyfill: false },
    rolldownOptions: {
      output: {
        codeSplitting: {
          groups: Object.keys(WHOLE).map((name, i) => ({
            name,
            priority: 2 - i,
            test: (id) => scriptOf.get(id) === name,
          })),
        },
      },
    },
  },
  server: { fs: { allow: ['..'] }, proxy: { '/v1': SERVER, '/healthz': SERVER } },
  // Some tests parse all sources: on a busy machine that takes longer than the usual five seconds.
  test: { include: ['test/**/*.test.{ts,tsx}'], environment: 'node', testTimeout: 60_000 },
});
