import { readWorkerStart } from './arguments.js';
import { MandolineError, named } from './errors.js';
import { openWorker } from './open-worker.js';
import { ownThread } from './own-thread.js';
import { physicsNames } from './physics-names.js';

export { MandolineError, describe } from './errors.js';

/** The calls of mandoline-wasm/physics, which the worker's script can't answer. */
const physics = Object.fromEntries(
  physicsNames.map((stage) => [
    stage,
    async () => {
      throw new MandolineError('badArgument', 'This worker only cuts: that of mandoline-wasm/physics/worker also computes.', { stage });
    },
  ]),
);

/** Starts a worker that has loaded the module. */
export async function createWorker(options) {
  return Object.setPrototypeOf(await openWorker(named('init', readWorkerStart)(options, 'wasm'), ownThread), physics);
}
