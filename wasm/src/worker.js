import { readWorkerOptions } from './arguments.js';
import { named } from './errors.js';
import { openWorker } from './open-worker.js';
import { ownThread } from './own-thread.js';
import { ownWasm } from './own-wasm.js';

export { MandolineError, describe } from './errors.js';

/** Starts a worker that has loaded the module. */
export async function createWorker(options) {
  const { wasm = ownWasm.source, thread } = named('init', readWorkerOptions)(options);
  return openWorker({ wasm, thread }, ownThread);
}
