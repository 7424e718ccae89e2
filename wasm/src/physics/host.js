import { bad, readCutMesh } from '../arguments.js';
import { Host } from '../host.js';
import { cutMeshes } from '../results.js';
import { readComplex } from './arguments.js';
import createModule from './module.js';

const calls = { cutMesh: 'cut()', cells: 'cellComplex(), subComplex() or regionComplex()' };

/**
 * The host of mandoline-wasm/physics. What has twins is of one of these kinds: a cut-mesh that cut() gave, and the results of the module's
 * own calls.
 */
export class PhysicsHost extends Host {
  #cutMeshArrays;
  #complexArrays;

  constructor(module) {
    super(createModule, module);
    this.#cutMeshArrays = this.start((bindings) => bindings.cutMeshArrays());
    this.#complexArrays = this.start((bindings) => bindings.complexArrays());
  }

  /** run() with a binding that takes a cut-mesh. */
  runOnCutMesh(cutMesh, f) {
    if (cutMeshes.has(cutMesh)) this.adopt(cutMesh, 'cutMesh');
    return this.#runOn('cutMesh', cutMesh, (bindings) => bindings.keepCutMesh(readCutMesh(cutMesh, this.#cutMeshArrays)), f);
  }

  /** The same with one that takes a cell complex. */
  runOnComplex(cells, f) {
    return this.#runOn('cells', cells, (bindings) => bindings.keepComplex(readComplex(cells, this.#complexArrays)), f);
  }

  #runOn(kind, value, read, f) {
    if (this.isResult(value) && this.originOf(value) !== kind) {
      throw bad(`${kind} must be what ${calls[kind]} gives, not what ${calls[this.originOf(value)]} does.`);
    }
    return this.runWith(value, read, f, this.isResult(value));
  }
}
