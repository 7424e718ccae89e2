// As ../inline.js, of mandoline-wasm/physics, and mandoline.wasm with it.
import { startScript, unpack } from '../unpack.js';

export { bricksWasm, filesWasm, wasm } from '../inline.js';

export const physicsWasm = () => unpack('GZIPPED_PHYSICS');

export const thread = () => startScript('WORKER_SCRIPT');
