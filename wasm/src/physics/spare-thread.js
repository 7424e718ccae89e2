// For the script of workers that compute, as in ../spare-thread.js.
import { address } from '../spare-wasm.js';
import { ownPhysicsThread } from './own-thread.js';

const { source } = ownPhysicsThread;
const inline = async () => ({ start: (await import('./inline.js')).thread, script: 'from mandoline-wasm/physics/inline' });

ownPhysicsThread.source = async () => (address() ? source() : inline());
