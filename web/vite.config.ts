import { defineConfig } from 'vite';
import { compactBunny } from './bunny';

export default defineConfig({
  // Relative addresses: the built page works from any sub-path.
  base: './',
  plugins: [compactBunny()],
  worker: { format: 'es', plugins: () => [compactBunny()] },
  build: { target: 'es2022', chunkSizeWarningLimit: 1000 },
});
