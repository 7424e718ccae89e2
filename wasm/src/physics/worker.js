import { readStart } from '../arguments.js';
import { named } from '../errors.js';
import { openWorker } from '../open-worker.js';
import { ownWasm } from '../own-wasm.js';
import { ownPhysicsThread } from './own-thread.js';
import { ownPhysicsWasm } from './own-wasm.js';
import { PhysicsCalls } from './worker-calls.js';

export { MandolineError, describe } from '../errors.js';

/** Starts a worker that has loaded the cutter's module, and loads that of physics when it is first asked to compute. */
export async function createWorker(options) {
  const { wasm = ownWasm.source, physicsWasm = ownPhysicsWasm.source, thread } = named('init', readStart)(options);
  return openWorker({ wasm, thread }, ownPhysicsThread, (queue, calls) => new PhysicsCalls(queue, calls, physicsWasm).all());
}
