import { defineConfig } from 'vite';
import { compactBunny } from './bunny';
import { smallThree } from './three';

export default defineConfig({
  // Relative addresses: the built page works from any sub-path.
  base: './',
  plugins: [compactBunny(), smallThree()],
  worker: { format: 'es', plugins: () => [compactBunny(), smallThree()] },
  build: { target: 'es2022', chunkSizeWarningLimit: 1000 },
});
