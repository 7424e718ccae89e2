import { readCutMesh } from './arguments.js';
import { MandolineError } from './errors.js';
import { instantiate } from './instance.js';
import { Twins } from './twins.js';

/** With less kept, a new instance has no more memory to give than the one that ran out of it. */
const muchKept = 2 ** 27;

/**
 * Keeps an instance of the module and the twins in it, and takes a new one, without twins, after a failure that may have left it broken or
 * with a memory that never shrinks.
 */
export class Host {
  #module;
  #instance; // { bindings, twins }
  #arrays;
  #results = new WeakSet(); // of this host's calls: they may have twins

  constructor(module) {
    this.#module = module;
    try {
      this.#arrays = this.#current().bindings.cutMeshArrays();
    } catch (cause) {
      throw new MandolineError('loadFailed', `The WebAssembly module could not be started: ${cause?.message ?? cause}.`, { stage: 'init', cause });
    }
  }

  /** The value of a binding's call; its error, and whatever the instance dies of, is thrown as a MandolineError. */
  run(f) {
    const kept = this.#instance?.twins.bytes ?? 0;
    try {
      return this.#attempt(f);
    } catch (error) {
      if (error.code !== 'outOfMemory' || kept < muchKept) throw error;
      return this.#attempt(f);
    }
  }

  /** The same with a binding that takes a cut-mesh: the twin of the result that this is, or else its arrays, which may have to pass a check. */
  runOn(cutMesh, f, checked = true) {
    return this.run((bindings, twins) => {
      const twin = twins.find(cutMesh);
      if (twin) return f(bindings, twin);
      const { value: handle, error } = bindings.keep(readCutMesh(cutMesh, this.#arrays), checked);
      if (error) return { error };
      const outcome = f(bindings, handle);
      if (checked && this.#results.has(cutMesh)) twins.keep(cutMesh, handle);
      else handle.delete();
      return outcome;
    });
  }

  /** Says that this is a result, so that it gets a twin when its arrays are read. */
  adopt(result) {
    this.#results.add(result);
  }

  hasTwin(result) {
    return this.#instance?.twins.has(result) ?? false;
  }

  freeTwin(result) {
    this.#instance?.twins.free(result);
  }

  #current() {
    this.#instance ??= { bindings: instantiate(this.#module), twins: new Twins() };
    return this.#instance;
  }

  #attempt(f) {
    try {
      const { bindings, twins } = this.#current();
      const { value, error } = f(bindings, twins);
      if (error) throw new MandolineError(error.code, error.message, error);
      return value;
    } catch (error) {
      if (!(error instanceof MandolineError) || error.code === 'outOfMemory') this.#instance = undefined;
      throw error instanceof MandolineError ? error : fatal(error);
    }
  }
}

/** What the engine throws, as opposed to C++: traps, exhausted stacks, arrays and memories that can't be allocated. */
function fatal(cause) {
  const memory = cause instanceof RangeError && !/stack/.test(cause.message);
  if (memory) return new MandolineError('outOfMemory', 'There is not enough memory for this call.', { cause });
  return new MandolineError('internalError', `The WebAssembly module failed: ${cause?.message ?? cause}.`, { cause });
}
