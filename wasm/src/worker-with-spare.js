import './spare-thread.js';

export * from './worker.js';
