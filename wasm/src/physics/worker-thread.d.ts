/**
 * The script of the workers of `mandoline-wasm/physics/worker`. A script of your own that imports it, instead of
 * `mandoline-wasm/worker-thread`, answers the same calls.
 */
export { serve } from '../worker-thread.js';
export type { ExtraCall, ExtraCallContext } from '../worker-thread.js';
