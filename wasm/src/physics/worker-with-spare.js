import './spare-thread.js';
import './spare-wasm.js';

export * from './worker.js';
