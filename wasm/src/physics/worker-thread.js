// The script of the workers of worker.js: ../worker-thread.js, which also answers the calls of mandoline-wasm/physics.
import { makeApi } from '../api.js';
import { parts } from '../parts.js';
import { physicsCalls } from './calls.js';
import { PhysicsHost } from './host.js';

export { serve } from '../worker-thread.js';

parts.set('physics', (module) => {
  const host = new PhysicsHost(module);
  return { host, calls: makeApi(host, physicsCalls) };
});
