/**
 * As `mandoline-wasm/inline`, for `initPhysics(inline)` and for createWorker() of `mandoline-wasm/physics/worker`; `init(inline)` takes it,
 * too.
 */
import type { Thread } from '../worker.js';

export { bricksWasm, filesWasm, wasm } from '../inline.js';

/** The bytes of physics.wasm. */
export function physicsWasm(): Promise<ArrayBuffer>;

/** Starts the script of workers that compute. In browsers it is a blob, which a content security policy allows by `worker-src blob:`. */
export function thread(): Thread;
