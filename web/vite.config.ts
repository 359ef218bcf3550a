import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { brotliCompressSync, constants, gzipSync } from 'node:zlib';
import type { Plugin, ProxyOptions } from 'vite';
import { defineConfig } from 'vitest/config';

// The server refuses requests whose Origin is not its own address; behind this proxy there is none.
const SERVER: ProxyOptions = {
  target: process.env.DRAGTRAFFIC_URL ?? 'http://127.0.0.1:8080',
  changeOrigin: true,
  configure: (proxy) => proxy.on('proxyReq', (request) => request.removeHeader('origin')),
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

// The production build is embedded into the server binary, so every asset has a hashed name and
// nothing is inlined into the page: the server's content security policy refuses inline code.
export default defineConfig({
  base: '/',
  plugins: [packed()],
  build: { outDir: 'dist', assetsInlineLimit: 0, target: 'es2022', modulePreload: { polyfill: false } },
  server: { fs: { allow: ['..'] }, proxy: { '/v1': SERVER, '/healthz': SERVER } },
  test: { include: ['test/**/*.test.{ts,tsx}'], environment: 'node' },
});
