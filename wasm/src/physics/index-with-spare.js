import './spare-wasm.js';

export * from './index.js';
