// The WebAssembly and the worker's script within JavaScript. build.mjs puts them in.
import { startScript, unpack } from './unpack.js';

export const wasm = () => unpack('GZIPPED_WASM');

export const thread = () => startScript('WORKER_SCRIPT');
