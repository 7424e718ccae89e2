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
    return this.runWith([this.#cutMeshInput(cutMesh)], (bindings, [twin], twins) => f(bindings, twin, twins));
  }

  /** The same with one that takes a cell complex. */
  runOnComplex(cells, f) {
    return this.runWith([this.#complexInput(cells)], (bindings, [twin], twins) => f(bindings, twin, twins));
  }

  /** The same with one that takes both: f(bindings, cutMeshTwin, cellsTwin). */
  runOnBoth(cutMesh, cells, f) {
    return this.runWith([this.#cutMeshInput(cutMesh), this.#complexInput(cells)], (bindings, twins) => f(bindings, ...twins));
  }

  #cutMeshInput(cutMesh) {
    if (cutMeshes.has(cutMesh)) this.adopt(cutMesh, 'cutMesh');
    const read = () => readCutMesh(cutMesh, this.#cutMeshArrays);
    return this.#input('cutMesh', cutMesh, read, (bindings, arrays) => bindings.keepCutMesh(arrays));
  }

  #complexInput(cells) {
    const read = () => readComplex(cells, this.#complexArrays);
    return this.#input('cells', cells, read, (bindings, arrays) => bindings.keepComplex(arrays));
  }

  #input(kind, value, read, make) {
    const isKept = this.isResult(value);
    if (isKept && this.originOf(value) !== kind) {
      throw bad(`${kind} must be what ${calls[kind]} gives, not what ${calls[this.originOf(value)]} does.`);
    }
    return { value, read, make, isKept };
  }
}
