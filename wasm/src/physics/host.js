import { readCutMesh } from '../arguments.js';
import { Host } from '../host.js';
import { cutMeshes } from '../results.js';
import { readComplex } from './arguments.js';
import createModule from './module.js';

/** The host of mandoline-wasm/physics. What has twins are cut-meshes that cut() gave, and the cell complexes of the module's own calls. */
export class PhysicsHost extends Host {
  #cutMeshArrays;
  #complexArrays;

  constructor(module) {
    super(createModule, module);
    this.#cutMeshArrays = this.start((bindings) => bindings.cutMeshArrays());
    this.#complexArrays = this.start((bindings) => bindings.complexArrays());
  }

  input({ kind }, value) {
    if (cutMeshes.has(value)) this.adopt(value, { kind: 'cutMesh' });
    this.expectKind(kind, value);
    const isKept = this.isResult(value);
    if (kind === 'cutMesh') {
      const make = (bindings, arrays) => bindings.keepCutMesh(arrays);
      return { value, read: () => readCutMesh(value, this.#cutMeshArrays), make, isKept };
    }
    return { value, read: () => readComplex(value, this.#complexArrays), make: (bindings, arrays) => bindings.keepComplex(arrays), isKept };
  }
}
