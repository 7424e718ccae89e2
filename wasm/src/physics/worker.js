import { readWorkerStart } from '../arguments.js';
import { named } from '../errors.js';
import { openWorker } from '../open-worker.js';
import { physicsCalls } from './calls.js';
import { ownPhysicsThread } from './own-thread.js';
import { ownPhysicsWasm } from './own-wasm.js';

export { MandolineError, describe } from '../errors.js';

/** Starts a worker that has loaded the cutter's module, and loads that of physics when it is first asked to compute. */
export async function createWorker(options) {
  const { physicsWasm = ownPhysicsWasm.source, ...start } = named('init', readWorkerStart)(options);
  return openWorker(start, ownPhysicsThread, { name: 'physics', calls: physicsCalls, source: physicsWasm });
}
