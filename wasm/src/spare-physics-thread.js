// The same for the script of workers that compute.
import { ownPhysicsThread } from './own-physics-thread.js';
import { address } from './spare-wasm.js';

const { source } = ownPhysicsThread;
const inline = async () => ({ start: (await import('./physics-inline.js')).thread, script: 'from mandoline-wasm/physics/inline' });

ownPhysicsThread.source = async () => (address() ? source() : inline());
