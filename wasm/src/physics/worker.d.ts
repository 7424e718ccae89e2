/** The worker of `mandoline-wasm/worker` that also computes: the calls of `mandoline-wasm/physics` as promises. Browsers and Node. */
import type { MandolineWorker, WorkerOptions } from '../worker.js';
import type { PhysicsOptions } from './index.js';
import type { WorkerCalls } from './signatures.js';

export { MandolineError, describe } from '../index.js';

/**
 * All calls run one after another, in the order they were made. The first one that computes loads the module for it. Results are
 * transferred, and the twins of cell complexes, and of cut-meshes that were computed with, stay in the thread (see CutMesh).
 */
export interface PhysicsWorker extends MandolineWorker, WorkerCalls {}

/** Starts a worker that has loaded the cutter's module. Errors as those of createWorker() of `mandoline-wasm/worker`. */
export function createWorker(options?: WorkerOptions & PhysicsOptions): Promise<PhysicsWorker>;
