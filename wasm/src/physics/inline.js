// As ../inline.js, of mandoline-wasm/physics, and mandoline.wasm with it.
import { startScript, unpack } from '../unpack.js';

export { wasm } from '../inline.js';

export const physicsWasm = () => unpack('GZIPPED_WASM');

export const thread = () => startScript('WORKER_SCRIPT');
