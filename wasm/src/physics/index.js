import { startModule, starter } from '../api.js';
import { compile } from '../load.js';
import { physicsModule } from './module.js';
import { ownPhysicsWasm } from './own-wasm.js';

export { MandolineError, describe } from '../errors.js';
export { faceTags, streamlineEnds } from './arguments.js';

/**
 * Loads the WebAssembly module, once: every call gives the same promise, for any options. After a failure the next call tries again.
 */
export const initPhysics = starter('initPhysics', 'physicsWasm', async ({ physicsWasm = ownPhysicsWasm.source }) => {
  return startModule(physicsModule, await compile(physicsWasm, 'physics.wasm')).calls;
});
