import './spare-physics-thread.js';
import './spare-physics-wasm.js';

export * from './physics-worker.js';
