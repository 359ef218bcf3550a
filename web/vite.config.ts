import { defineConfig } from 'vitest/config';

const SERVER = process.env.DRAGTRAFFIC_URL ?? 'http://127.0.0.1:8080';

// The production build is embedded into the server binary, so every asset has a hashed name and
// nothing is inlined into the page: the server's content security policy refuses inline code.
export default defineConfig({
  base: '/',
  build: { outDir: 'dist', assetsInlineLimit: 0, target: 'es2022', modulePreload: { polyfill: false } },
  server: { fs: { allow: ['..'] }, proxy: { '/v1': SERVER, '/healthz': SERVER } },
  test: { include: ['test/**/*.test.ts'], environment: 'node' },
});
