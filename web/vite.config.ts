import { defineConfig } from 'vite';

export default defineConfig({
  // Relative addresses: the built page works from any sub-path.
  base: './',
  worker: { format: 'es' },
  build: { target: 'es2022', chunkSizeWarningLimit: 1000 },
});
