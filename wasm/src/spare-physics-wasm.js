// The same for physics.wasm.
import { addressOf } from './beside.js';
import { ownPhysicsWasm } from './own-physics-wasm.js';

const { source } = ownPhysicsWasm;

ownPhysicsWasm.source = async () => addressOf('physics.wasm', source) ?? (await import('./physics-inline.js')).physicsWasm();
