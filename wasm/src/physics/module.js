// As ../module.js, of mandoline-wasm/physics.
import { cutMesh } from '../kinds.js';
import { readComplex } from './arguments.js';
import { physicsCalls } from './calls.js';
import createModule from './physics.js';

const cells = { read: readComplex, make: (bindings, arrays) => bindings.keepComplex(arrays) };

export const physicsModule = { name: 'physics', createModule, kinds: { cutMesh, cells }, calls: physicsCalls };
