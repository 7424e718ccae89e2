import { bad } from './arguments.js';
import { MandolineError } from './errors.js';
import { instantiate } from './instance.js';
import { Twins } from './twins.js';

/** What gives the kinds of results that may have twins. */
const makers = {
  prepared: 'prepare()',
  cutMesh: 'cut()',
  cells: 'cellComplex(), refineCells(), mergeSmallCells(), uniteWalls(), subComplex() or regionComplex()',
};

/** What calls of any of the package's modules gave: { host, kind }. Each module may have a twin of a cut-mesh. */
const results = new WeakMap();

export const isResult = (value) => results.has(value);

/** The data of the twin in the module that gave the result, if it is there. */
const dataOf = (result) => results.get(result)?.host.dataOf(result);

/** Throws if this is a result of another kind. */
function expectKind(kind, value) {
  const found = results.get(value)?.kind ?? kind;
  const name = kind === 'prepared' ? 'mesh' : kind;
  if (found !== kind) throw bad(`${name} must be what ${makers[kind]} gives, not what ${makers[found]} does.`);
}

/** If less than this is kept, a new instance has no more free memory than the one that ran out of it. */
const muchKept = 2 ** 25;

/**
 * Keeps an instance of a module and the twins in it, and takes a new one, without twins, after a failure that may have left it broken or
 * with a memory that never shrinks.
 */
export class Host {
  #createModule;
  #module;
  #kinds;
  #instance; // { bindings, twins }
  #results = new WeakMap(); // of this host's calls, which may have twins: their origins, as given to adopt()

  /**
   * `kinds`: per kind of what may have twins { read, make }. read(value) gives its data; make(bindings, data, { taken, origin, progress })
   * gives { value: handle } or { error }, with `taken` as in calls.js and `origin` as adopt() was told.
   */
  constructor({ createModule, kinds }, module) {
    this.#createModule = createModule;
    this.#module = module;
    this.#kinds = kinds;
  }

  /** f(bindings) of the first instance. */
  start(f) {
    try {
      return f(this.#current().bindings);
    } catch (cause) {
      const message = `The WebAssembly module could not be started: ${cause?.message ?? cause}.`;
      throw new MandolineError('loadFailed', message, { stage: 'init', cause });
    }
  }

  /** The value of a binding's call. Its error is thrown as a MandolineError, and so is a trap that ends the instance. */
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
   * The same with a binding that takes values that may have twins, f(bindings, handles, twins). An input is { value, read, make, isKept },
   * as input() gives it. Its handle is that of its twin; if it has none, make() makes one of what read() returns, and that
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

  /** Marks a value as a result, with its origin ({ kind, ...options }), so that it gets a twin when its arrays are read. */
  adopt(result, origin) {
    this.#results.set(result, origin);
    if (!results.has(result)) results.set(result, { host: this, kind: origin.kind });
  }

  /** What runWith() takes for an argument, which is `taken` as in calls.js. */
  input(taken, value, progress) {
    const { kind, isChecked = true } = taken;
    expectKind(kind, value);
    if (isResult(value) && !this.#results.has(value)) this.adopt(value, { kind }); // of another module
    const { read, make } = this.#kinds[kind];
    const origin = this.originOf(value);
    return {
      value,
      read: () => dataOf(value) ?? read(value),
      make: (bindings, data) => make(bindings, data, { taken, origin, progress }),
      isKept: isChecked && isResult(value),
    };
  }

  originOf(value) {
    return this.#results.get(value);
  }

  /** The data of a cut-mesh's twin, if it is there. */
  dataOf(cutMesh) {
    return this.hasTwin(cutMesh) ? this.run((bindings, twins) => bindings.dataOf(twins.find(cutMesh))) : undefined;
  }

  /** Whether these are still the bindings that calls use. */
  isCurrent(bindings) {
    return this.#instance?.bindings === bindings;
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

/** Errors that the engine throws, not C++: traps, exhausted stacks, arrays and memories that can't be allocated. */
function fatal(cause) {
  const memory = cause instanceof RangeError && !/stack/.test(cause.message);
  if (memory) return new MandolineError('outOfMemory', 'There is not enough memory for this call.', { cause });
  return new MandolineError('internalError', `The WebAssembly module failed: ${cause?.message ?? cause}.`, { cause });
}
