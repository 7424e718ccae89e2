import './spare.js';

export * from './index.js';
