import { readIntersections } from './arguments.js';
import { buffersOf, clone } from './buffers.js';
import { MandolineError } from './errors.js';

/**
 * The calls of the main entry with their numbers of arguments before the options, which of these may have a twin, and whether what they
 * give, or a member of it that isKept names, has one.
 */
const cutCalls = {
  prepare: { count: 1, isKept: true },
  cut: { count: 2, at: 0, isKept: true },
  findIntersections: { count: 1 },
  resolve: { count: 1 },
  boundary: { count: 2, at: 0 },
  validate: { count: 2, at: 1 },
  measure: { count: 2, at: 1 },
  cutEdges: { count: 2, at: 1 },
  adjacency: { count: 1, at: 0 },
  triangulate: { count: 2, at: 0 },
  cellAt: { count: 2, at: 0 },
  cellsAt: { count: 2, at: 0 },
  slice: { count: 2, at: 0 },
  slices: { count: 3, at: 0 },
  outlines: { count: 3, at: 0 },
  write: { count: 3, at: 1 },
  readMesh: { count: 1 },
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

  /** What the thread is sent: the argument that the message names by its id goes along unless there is a twin of it. */
  pack(message, twins, argument) {
    const { subject } = message;
    if (subject && !twins.has(subject.id)) subject.data ??= copied(message.call, lean(argument));
    return { message, transfer: buffersOf([message.args, subject?.data]) }; // of the copies: they go on to the thread
  }

  #own(call, given) {
    const { count, ...asked } = this.#calls[call];
    const args = Array.from({ length: count }, (_, i) => given[i]);
    return this.#perform({ call, args, ...asked }, given[count]);
  }

  /** A call that the thread's script serves. */
  extra(call, args, options) {
    return this.#perform({ call, args, extra: true }, options);
  }

  async #perform(asked, given) {
    const { call, args } = asked;
    if (!Array.isArray(args)) throw bad(call, 'The arguments of a call must be an array.');
    const split = splitOptions(call, given);
    const { signal, onProgress } = split;
    const cancellation = () => new MandolineError('cancelled', 'The call was cancelled.', { stage: call, cause: signal.reason });
    if (signal?.aborted) throw cancellation();
    const message = this.#message(asked, split);
    const job = { call, onProgress, message, ready: this.ready, pack: (packed, twins) => this.pack(packed, twins, args[asked.at]) };
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

  /** In it: `subject`, { id, origin, at, data } of an argument that is a result of this queue, and `result`, the id of a new one. */
  #message({ call, args, extra, at, isKept }, { options, transfer, onProgress }) {
    const message = { call, extra, args, options, progress: onProgress !== undefined };
    if (isKept) Object.assign(message, { isKept, result: this.#queue.newId() });
    const known = this.find(args[at]);
    if (known) {
      const isMoved = buffersOf(args[at]).some((buffer) => transfer.includes(buffer));
      const data = isMoved || !this.#queue.hasTwin(known.id) ? lean(args[at]) : undefined;
      Object.assign(message, { args: args.with(at, undefined), subject: { ...known, at, data } });
    } else if (at !== undefined) {
      message.args = args.with(at, lean(args[at]));
    }
    return copied(call, message, transfer);
  }
}
