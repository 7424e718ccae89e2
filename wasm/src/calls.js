import { expectAllAttached, readIntersections } from './arguments.js';
import { buffersOf, clone } from './buffers.js';
import { MandolineError, named } from './errors.js';
import { valueAt, withValueAt } from './places.js';

const [first, second] = [[[0]], [[1]]];

/**
 * The calls of the main entry with their numbers of arguments before the options, the places in these of what may have a twin, and whether
 * what they give, or a member of it that isKept names, has one. Errors of those that have stages of a cut (isCut) name the stage. isFile:
 * the argument may be a File.
 */
const cutCalls = {
  prepare: { count: 1, isKept: true, isCut: true },
  cut: { count: 2, at: first, isKept: true, isCut: true },
  findIntersections: { count: 1 },
  resolve: { count: 1, isCut: true },
  boundary: { count: 2, at: first },
  validate: { count: 2, at: second },
  measure: { count: 2, at: second },
  cutEdges: { count: 2, at: second },
  adjacency: { count: 1, at: first },
  triangulate: { count: 2, at: first },
  cellAt: { count: 2, at: first },
  cellsAt: { count: 2, at: first },
  slice: { count: 2, at: first },
  slices: { count: 3, at: first },
  outlines: { count: 3, at: first },
  write: { count: 3, at: second },
  readMesh: { count: 1, isFile: true },
};

const isObject = (value) => typeof value === 'object' && value !== null;
const bad = (call, message, cause) => new MandolineError('badArgument', message, { stage: call, cause });

/** The options of the call itself, and those that stay here. */
function splitOptions(call, options = {}) {
  if (!isObject(options)) return { transfer: [], options }; // the call says what it is not
  const { signal, transfer = [], ...own } = options;
  if (signal !== undefined && !(signal instanceof AbortSignal)) throw bad(call, 'options.signal must be an AbortSignal.');
  if (!Array.isArray(transfer)) throw bad(call, 'options.transfer must be an array.');
  if (typeof own.progress !== 'function') return { signal, transfer, options: own };
  const { progress, ...rest } = own;
  return { signal, transfer, onProgress: progress, options: rest };
}

/** The options with the File's name, which its clone does not have in Node 20. */
function withFileName(options, file) {
  const isNamed = typeof file?.name === 'string' && (options === undefined || (isObject(options) && options.name === undefined));
  return isNamed ? { ...options, name: file.name } : options;
}

/** What has the twin: a result, or its member of that name. */
export function memberOf(value, isKept) {
  return isKept === true ? value : value[isKept];
}

/** A cut-mesh without gridCellRegion, which no call reads and which may be large. */
function lean(argument) {
  if (!isObject(argument) || !('gridCellRegion' in argument)) return argument;
  const { gridCellRegion, ...rest } = argument;
  return rest;
}

/** Copies of the values as they are now, so that neither the queue nor the worker sees later changes. */
function copied(call, values, transfer = []) {
  try {
    return clone(values, transfer);
  } catch (cause) {
    named(call, expectAllAttached)(values);
    throw bad(call, `The arguments can't be given to the worker: ${cause.message}`, cause);
  }
}

/** Puts calls into a queue of jobs, and knows the results whose twins may be in its thread. */
export class Calls {
  #queue;
  #calls;
  #results = new WeakMap(); // { id, origin }: the latter is for the thread's host, see originOf()
  #collected = new FinalizationRegistry((id) => this.#queue.freeTwin(id));

  /** `calls`: as in cutCalls. */
  constructor(queue, calls = cutCalls) {
    this.#queue = queue;
    this.#calls = calls;
  }

  /** The package's calls by their names. */
  all() {
    return Object.fromEntries(Object.keys(this.#calls).map((name) => [name, (...given) => this.#own(name, given)]));
  }

  isResult(value) {
    return this.#results.has(value);
  }

  /** What Host.adopt() is to be told of a result: the options of those that prepare() gave. */
  originOf(call, options) {
    return call === 'prepare' ? { intersections: readIntersections(options) } : undefined;
  }

  /** The id and the origin of an argument that may have a twin. */
  find(argument) {
    return this.#results.get(argument);
  }

  /** From now on this is a result. */
  note(value, id, origin) {
    const known = { id, origin };
    this.#results.set(value, known);
    this.#collected.register(value, id);
    return known;
  }

  /** What the thread is sent: each value that the message names by its id goes along unless there is a twin of it. */
  pack(message, twins, values) {
    for (const [i, subject] of message.subjects.entries()) {
      if (!twins.has(subject.id)) subject.data ??= copied(message.call, lean(values[i]));
    }
    return { message, transfer: buffersOf([message.args, message.subjects]) }; // of the copies: they go on to the thread
  }

  #own(call, given) {
    const { count, isFile, ...asked } = this.#calls[call];
    const args = Array.from({ length: count }, (_, i) => given[i]);
    return this.#perform({ call, args, ...asked }, isFile ? withFileName(given[count], args[0]) : given[count]);
  }

  /** A call that the thread's script serves. */
  extra(call, args, options) {
    return this.#perform({ call, args, extra: true }, options);
  }

  async #perform(asked, given) {
    const { call, args, isCut } = asked;
    if (!Array.isArray(args)) throw bad(call, 'The arguments of a call must be an array.');
    const split = splitOptions(call, given);
    const { signal, onProgress } = split;
    const cancellation = () => new MandolineError('cancelled', 'The call was cancelled.', { stage: call, cause: signal.reason });
    if (signal?.aborted) throw cancellation();
    const { message, values } = this.#message(asked, split);
    const job = { call, isCut, onProgress, message, ready: this.ready, pack: (packed, twins) => this.pack(packed, twins, values) };
    const abort = () => this.#queue.stop(job, cancellation());
    signal?.addEventListener('abort', abort);
    try {
      const { value, kept } = await new Promise((resolve, reject) => {
        this.#queue.add(Object.assign(job, { resolve, reject }));
      });
      if (kept.includes(message.result)) this.note(memberOf(value, asked.isKept), message.result, this.originOf(call, message.options));
      return value;
    } finally {
      signal?.removeEventListener('abort', abort);
    }
  }

  /**
   * In it: `subjects`, { id, origin, at, data } of each result of this queue that lies at one of these places in the arguments, and
   * `result`, the id of a new one. Beside it: the results themselves.
   */
  #message({ call, args, extra, at = [], isKept }, { options, transfer, onProgress }) {
    const message = { call, extra, args, subjects: [], options, progress: onProgress !== undefined };
    const values = [];
    if (isKept) Object.assign(message, { isKept, result: this.#queue.newId() });
    for (const place of at) {
      const value = valueAt(args, place);
      if (!isObject(value)) continue;
      const known = this.find(value);
      message.args = withValueAt(message.args, place, known ? undefined : lean(value));
      if (!known) continue;
      const isMoved = buffersOf(value).some((buffer) => transfer.includes(buffer));
      message.subjects.push({ ...known, at: place, data: isMoved || !this.#queue.hasTwin(known.id) ? lean(value) : undefined });
      values.push(value);
    }
    return { message: copied(call, message, transfer), values };
  }
}
