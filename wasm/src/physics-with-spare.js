import './spare-physics-wasm.js';

export * from './physics.js';
