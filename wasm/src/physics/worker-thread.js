// The script of the workers of worker.js: ../worker-thread.js, which also answers the calls of mandoline-wasm/physics.
import { parts } from '../parts.js';
import { physicsModule } from './module.js';

export { serve } from '../worker-thread.js';

parts.set(physicsModule.name, physicsModule);
