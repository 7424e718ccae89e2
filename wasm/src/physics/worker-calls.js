import { compile } from '../load.js';
import { Calls } from '../worker-calls.js';
import { physicsCalls } from './calls.js';

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
    this.#module ??= await compile(this.#source, 'physics.wasm');
  };

  find(argument) {
    const made = this.#cutting.find(argument);
    const isNew = made?.origin.kind === 'cutMesh' && !this.isResult(argument);
    return isNew ? this.note(argument, this.#queue.newId(), { kind: 'cutMesh' }) : super.find(argument);
  }

  pack(message, twins, values) {
    const part = 'physics';
    return super.pack(Object.assign(message, { part, module: twins.has(part) ? undefined : this.#module }), twins, values);
  }
}
