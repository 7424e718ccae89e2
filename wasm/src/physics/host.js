import { readCutMesh } from '../arguments.js';
import { Host } from '../host.js';
import { cutMeshes } from '../cut-meshes.js';
import { readComplex } from './arguments.js';
import createModule from './module.js';

/** The host of mandoline-wasm/physics. What has twins are cut-meshes that cut() gave, and the cell complexes of the module's own calls. */
export class PhysicsHost extends Host {
  constructor(module) {
    super(createModule, module);
  }

  input({ kind }, value) {
    if (cutMeshes.has(value)) this.adopt(value, { kind: 'cutMesh' });
    this.expectKind(kind, value);
    const isKept = this.isResult(value);
    if (kind === 'cutMesh') {
      const make = (bindings, arrays) => bindings.keepCutMesh(arrays);
      return { value, read: () => readCutMesh(value), make, isKept };
    }
    return { value, read: () => readComplex(value), make: (bindings, arrays) => bindings.keepComplex(arrays), isKept };
  }
}
