// As spare-wasm.js, for the worker's script.
import { ownThread } from './own-thread.js';
import { address } from './spare-wasm.js';

const { source } = ownThread;

ownThread.source = async () =>
  address() ? source() : { start: (await import('./inline.js')).thread, script: 'from mandoline-wasm/inline' };
