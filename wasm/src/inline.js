// The WebAssembly and the worker's script within JavaScript. build.mjs puts them in.
import { startScript, unpack } from './unpack.js';

export const wasm = () => unpack('GZIPPED_MANDOLINE');

export const filesWasm = () => unpack('GZIPPED_FILES');

export const bricksWasm = () => unpack('GZIPPED_BRICKS');

export const thread = () => startScript('WORKER_SCRIPT');
