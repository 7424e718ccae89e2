import { Calls } from '../calls.js';
import { compile } from '../load.js';

const [first, second] = [[[0]], [[1]]];
const field = [
  [0, 'cutMesh'],
  [0, 'cells'],
];

/** As in ../calls.js. */
const physicsCalls = {
  coarsen: { count: 1, at: first },
  cellComplex: { count: 3, at: second, isKept: true },
  subComplex: { count: 2, at: first, isKept: 'cells' },
  regionComplex: { count: 2, at: first, isKept: 'cells' },
  complexEdges: { count: 1, at: first },
  operators: { count: 1, at: first },
  boundaryOf: { count: 2, at: first },
  outwardNormals: { count: 2, at: second },
  cellComponents: { count: 1, at: first },
  poissonSystem: { count: 2, at: first },
  solvePoisson: { count: 2, at: first },
  solveFlow: { count: 2, at: first },
  velocityAt: { count: 2, at: field },
  streamlines: { count: 2, at: field },
  inflowSeeds: { count: 3 },
  readGroups: { count: 1, isFile: true },
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

  pack(message, twins, values) {
    const part = 'physics';
    return super.pack(Object.assign(message, { part, module: twins.has(part) ? undefined : this.#module }), twins, values);
  }
}
