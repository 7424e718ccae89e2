// For physics.wasm, as in ../spare-wasm.js.
import { addressOf } from '../beside.js';
import { ownPhysicsWasm } from './own-wasm.js';

const { source } = ownPhysicsWasm;

ownPhysicsWasm.source = async () => addressOf('physics.wasm', source, import.meta.url) ?? (await import('./inline.js')).physicsWasm();
