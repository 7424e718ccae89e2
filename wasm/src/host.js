import { bad, readCutMesh } from './arguments.js';
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
  #results = new WeakMap(); // of this host's calls, which may have twins: the options of prepare(), or undefined for a cut-mesh

  constructor(module) {
    this.#module = module;
    try {
      this.#arrays = this.#current().bindings.cutMeshArrays();
    } catch (cause) {
      const message = `The WebAssembly module could not be started: ${cause?.message ?? cause}.`;
      throw new MandolineError('loadFailed', message, { stage: 'init', cause });
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

  /**
   * The same with a binding that takes a cut-mesh: the twin of the result that this is, or else its arrays, which may have to pass a
   * check.
   */
  runOn(cutMesh, f, checked = true) {
    if (this.preparationOf(cutMesh)) throw bad('cutMesh must be what cut() gives, not what prepare() does.');
    const read = (bindings) => bindings.keep(readCutMesh(cutMesh, this.#arrays), checked);
    return this.#runWith(cutMesh, read, f, checked && this.isResult(cutMesh));
  }

  /** The same with a binding that takes a mesh that prepare() gave: its twin, or else what `again` gives, which does it once more. */
  runOnPrepared(mesh, again, f) {
    return this.#runWith(mesh, again, f, true);
  }

  /** Says that this is a result, of prepare() with such options or of cut(), so that it gets a twin when its arrays are read. */
  adopt(result, preparation) {
    this.#results.set(result, preparation);
  }

  isResult(value) {
    return this.#results.has(value);
  }

  /** The options of the prepare() that gave this mesh, if one did. */
  preparationOf(mesh) {
    return this.#results.get(mesh);
  }

  hasTwin(result) {
    return this.#instance?.twins.has(result) ?? false;
  }

  freeTwin(result) {
    this.#instance?.twins.free(result);
  }

  /** `read` makes the handle of a result that has no twin. */
  #runWith(result, read, f, isKept) {
    return this.run((bindings, twins) => {
      const twin = twins.find(result);
      if (twin) return f(bindings, twin, twins);
      const { value: handle, error } = read(bindings);
      if (error) return { error };
      if (isKept) twins.keep(result, handle);
      const outcome = f(bindings, handle, twins);
      if (!isKept) handle.delete();
      return outcome;
    });
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
