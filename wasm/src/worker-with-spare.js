import './spare.js';

export * from './worker.js';
