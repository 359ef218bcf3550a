import type { ProxyOptions } from 'vite';
import { defineConfig } from 'vitest/config';

// The server refuses requests whose Origin is not its own address; behind this proxy there is none.
const SERVER: ProxyOptions = {
  target: process.env.DRAGTRAFFIC_URL ?? 'http://127.0.0.1:8080',
  changeOrigin: true,
  configure: (proxy) => proxy.on('proxyReq', (request) => request.removeHeader('origin')),
};

// The production build is embedded into the server binary, so every asset has a hashed name and
// nothing is inlined into the page: the server's content security policy refuses inline code.
export default defineConfig({
  base: '/',
  build: { outDir: 'dist', assetsInlineLimit: 0, target: 'es2022', modulePreload: { polyfill: false } },
  server: { fs: { allow: ['..'] }, proxy: { '/v1': SERVER, '/healthz': SERVER } },
  test: { include: ['test/**/*.test.{ts,tsx}'], environment: 'node' },
});
