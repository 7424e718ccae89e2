import { makeApi } from '../api.js';
import { readStart } from '../arguments.js';
import { named } from '../errors.js';
import { compile } from '../load.js';
import { physicsCalls } from './calls.js';
import { PhysicsHost } from './host.js';
import { ownPhysicsWasm } from './own-wasm.js';

export { MandolineError, describe } from '../errors.js';
export { faceTags, streamlineEnds } from './arguments.js';

let started;

async function start({ physicsWasm = ownPhysicsWasm.source }) {
  return makeApi(new PhysicsHost(await compile(physicsWasm, 'physics.wasm')), physicsCalls);
}

/**
 * Loads the WebAssembly module, once: every call gives the same promise, for any options. After a failure the next call tries again.
 */
export function initPhysics(given) {
  try {
    const options = named('initPhysics', readStart)(given, 'physicsWasm');
    if (started) return started;
    started = start(options);
    started.catch(() => {
      started = undefined;
    });
    return started;
  } catch (error) {
    return Promise.reject(error);
  }
}
