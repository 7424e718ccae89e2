import { Calls } from '../calls.js';
import { compile } from '../load.js';

/** As in ../calls.js. */
const physicsCalls = {
  coarsen: { count: 1, at: 0 },
  cellComplex: { count: 3, at: 1, isKept: true },
  subComplex: { count: 2, at: 0, isKept: 'cells' },
  regionComplex: { count: 2, at: 0, isKept: 'cells' },
  complexEdges: { count: 1, at: 0 },
  operators: { count: 1, at: 0 },
  boundaryOf: { count: 2, at: 0 },
  outwardNormals: { count: 2, at: 1 },
  cellComponents: { count: 1, at: 0 },
  poissonSystem: { count: 2, at: 0 },
  solvePoisson: { count: 2, at: 0 },
  solveFlow: { count: 2, at: 0 },
};

/** The calls of mandoline-wasm/physics in the same queue. The module is compiled when the first is made, and goes along with it. */
export class PhysicsCalls extends Calls {
  #queue;
  #cutting;
  #source;
  #module;

  /** `cutting`: the calls of the main entry, whose cut-meshes get twins in the physics module, too. */
  constructor(queue, cutting, source) {
    super(queue, physicsCalls);
    this.#queue = queue;
    this.#cutting = cutting;
    this.#source = source;
  }

  ready = async () => {
    this.#module ??= await compile(this.#source);
  };

  find(argument) {
    const made = this.#cutting.find(argument);
    const isNew = made && !made.origin && !this.isResult(argument);
    return isNew ? this.note(argument, this.#queue.newId(), 'cutMesh') : super.find(argument);
  }

  originOf() {
    return 'cells';
  }

  pack(message, twins, argument) {
    const part = 'physics';
    return super.pack(Object.assign(message, { part, module: twins.has(part) ? undefined : this.#module }), twins, argument);
  }
}
