import { bad } from './arguments.js';
import { MandolineError } from './errors.js';
import { instantiate } from './instance.js';
import { Twins } from './twins.js';

/** What gives the kinds of results that may have twins. */
const makers = { prepared: 'prepare()', cutMesh: 'cut()', cells: 'cellComplex(), subComplex() or regionComplex()' };

/** With less kept, a new instance has no more memory to give than the one that ran out of it. */
const muchKept = 2 ** 27;

/**
 * Keeps an instance of a module and the twins in it, and takes a new one, without twins, after a failure that may have left it broken or
 * with a memory that never shrinks.
 */
export class Host {
  #createModule;
  #module;
  #instance; // { bindings, twins }
  #results = new WeakMap(); // of this host's calls, which may have twins: how they came about, as adopt() was told

  constructor(createModule, module) {
    this.#createModule = createModule;
    this.#module = module;
  }

  /** What f makes of the bindings of the first instance. */
  start(f) {
    try {
      return f(this.#current().bindings);
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
   * The same with a binding that takes values that may have twins, f(bindings, handles, twins). For each, { value, read, make, isKept }, as
   * input() of the kinds of hosts gives it: the handle is that of its twin, or else the one that `make` gives of what `read` does, which
   * becomes the twin if it is to be kept.
   */
  runWith(inputs, f) {
    return this.run((bindings, twins) => {
      const data = inputs.map(({ value, read }) => (twins.has(value) ? undefined : read())); // before there are handles, since it may throw
      const handles = inputs.map(({ value }) => twins.find(value));
      const lent = [];
      let outcome;
      for (const [i, { value, make, isKept }] of inputs.entries()) {
        if (handles[i]) continue;
        const { value: handle, error } = make(bindings, data[i]);
        if (error) {
          outcome = { error };
          break;
        }
        handles[i] = handle;
        if (isKept) twins.keep(value, handle, handles);
        else lent.push(handle);
      }
      outcome ??= f(bindings, handles, twins);
      for (const handle of lent) handle.delete();
      return outcome;
    });
  }

  /** Says that this is a result, and how it came about ({ kind, ...options }), so that it gets a twin when its arrays are read. */
  adopt(result, origin) {
    this.#results.set(result, origin);
  }

  isResult(value) {
    return this.#results.has(value);
  }

  originOf(value) {
    return this.#results.get(value);
  }

  /** Throws if this is a result of another kind. */
  expectKind(kind, value) {
    const found = this.originOf(value)?.kind ?? kind;
    const name = kind === 'prepared' ? 'mesh' : kind;
    if (found !== kind) throw bad(`${name} must be what ${makers[kind]} gives, not what ${makers[found]} does.`);
  }

  hasTwin(result) {
    return this.#instance?.twins.has(result) ?? false;
  }

  freeTwin(result) {
    this.#instance?.twins.free(result);
  }

  #current() {
    this.#instance ??= { bindings: instantiate(this.#createModule, this.#module), twins: new Twins() };
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
