// The calls of a table (see calls.js), on a worker.
import { bad, expectAllAttached, kindOf, readFunction, readOptions } from './arguments.js';
import { buffersOf, clone } from './buffers.js';
import { MandolineError, named } from './errors.js';
import { makeObject } from './objects.js';
import { valueAt, withValueAt } from './places.js';

const isObject = (value) => typeof value === 'object' && value !== null;

/** What every call of a worker takes beside its own options. */
const callOptions = {
  signal: (value, name) => {
    if (value !== undefined && !(value instanceof AbortSignal)) throw bad(`${name} must be an AbortSignal, not ${kindOf(value)}.`);
    return value;
  },
  transfer: (value = [], name) => {
    if (!Array.isArray(value)) throw bad(`${name} must be an array, not ${kindOf(value)}.`);
    return value;
  },
};

/** What a call that the thread's script serves takes. */
const extra = { options: { progress: readFunction }, isExtra: true };

/** The options of the call itself, read (`what`) and as they were given, if there are any; and those that stay here. */
function splitOptions(given, readers) {
  const { signal, transfer, progress, reuse: _reuse, ...what } = readOptions(given, { ...readers, ...callOptions });
  if (given === undefined) return { what, transfer };
  const { signal: _, transfer: __, progress: ___, ...options } = given;
  return { what, options, signal, transfer, onProgress: progress };
}

/** The places of arguments that may have twins. */
function placesIn(takes) {
  const membersOf = (taken) => (typeof taken === 'object' ? Object.keys(taken).filter((key) => taken[key].kind) : []);
  return Object.values(takes).flatMap((taken, i) => (taken.kind ? [[i]] : membersOf(taken).map((key) => [i, key])));
}

/** The options with the File's name, which its clone does not have in Node 20. */
function withFileName(options, file) {
  const isNamed = typeof file?.name === 'string' && options?.name === undefined;
  return isNamed ? { ...options, name: file.name } : options;
}

/** The value that has the twin: a result, or its member of that name. */
export function memberOf(value, member) {
  return member === undefined ? value : value[member];
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
    throw new MandolineError('badArgument', `The arguments can't be given to the worker: ${cause.message}`, { stage: call, cause });
  }
}

/** Puts calls into a queue of jobs, and knows the results whose twins may be in its thread. */
export class Calls {
  #queue;
  #modules;
  #results = new WeakMap(); // { id, origin }: the latter is for the thread's host, see Host.adopt()
  #collected = new FinalizationRegistry((id) => this.#queue.freeTwin(id));

  /** `modules`: { name, calls } of each, as in module.js. */
  constructor(queue, modules) {
    this.#queue = queue;
    this.#modules = modules;
  }

  /** The package's calls by their names. */
  all() {
    const calls = this.#modules.flatMap((module) =>
      Object.entries(module.calls).map(([name, call]) => [name, { ...call, part: module.name }]),
    );
    return Object.fromEntries(calls.map(([name, call]) => [name, (...given) => this.#own(name, call, given)]));
  }

  /** Marks a value as a result, whether or not a twin of it is in the thread yet. */
  #note(value, id, origin) {
    this.#results.set(value, { id, origin });
    this.#collected.register(value, id);
  }

  /** The message for the thread: values that it names by id are included unless the thread has their twins. */
  #pack(message, twins, values) {
    for (const [i, subject] of message.subjects.entries()) {
      if (!twins.has(subject.id)) subject.data ??= copied(message.call, lean(values[i]));
    }
    const { args, subjects, options } = message;
    return { message, transfer: buffersOf([args, subjects, options]) }; // of the copies: they go on to the thread
  }

  #own(name, call, given) {
    const count = Object.keys(call.takes).length;
    const args = Array.from({ length: count }, (_, i) => given[i]);
    return this.#perform(name, { ...call, at: placesIn(call.takes) }, args, given[count]);
  }

  /** A call that the thread's script serves. */
  extra(name, args, options) {
    return this.#perform(name, extra, args, options);
  }

  async #perform(name, call, args, given) {
    const { isCut, isFile, keeps, member, gives, part } = call;
    if (!Array.isArray(args)) throw new MandolineError('badArgument', 'The arguments of a call must be an array.', { stage: name });
    const split = named(isCut ? 'input' : name, splitOptions)(given, call.options);
    if (isFile) split.options = withFileName(split.options, args[0]);
    const { signal, onProgress } = split;
    const cancellation = () => new MandolineError('cancelled', 'The call was cancelled.', { stage: name, cause: signal.reason });
    if (signal?.aborted) throw cancellation();
    const { message, values } = this.#message(name, call, args, split);
    const pack = (packed, twins) => this.#pack(packed, twins, values);
    const job = { call: name, isCut, onProgress, message, pack };
    const abort = () => this.#queue.stop(job, cancellation());
    signal?.addEventListener('abort', abort);
    try {
      const value = await new Promise((resolve, reject) => {
        this.#queue.add(Object.assign(job, { resolve, reject }));
      });
      if (keeps && split.what.keep !== false) this.#note(memberOf(value, member), message.result, { kind: keeps, ...split.what });
      return gives ? this.#object(gives, part, message.object) : value;
    } finally {
      signal?.removeEventListener('abort', abort);
    }
  }

  /** The object of this id in the thread. */
  #object(gives, part, id) {
    const perform = async (method, given, expectState) => {
      named(method, expectState)();
      const call = { ...gives.methods[method], part, of: { id, type: gives.type } };
      const count = Object.keys(call.takes).length;
      return this.#perform(method, call, given.slice(0, count), given[count]);
    };
    return makeObject(gives, perform, () => this.#queue.freeObject(id));
  }

  /**
   * In it: `subjects`, { id, origin, at, data } of each result of this queue that lies at one of these places in the arguments; `result`,
   * the id of a new one; `object`, that of a new object; `of`, the object whose method is called. Beside it: the results themselves.
   */
  #message(name, { part, isExtra, at = [], keeps, member, gives, of }, args, { options, transfer, onProgress }) {
    const message = { call: name, part, isExtra, of, args, subjects: [], options, progress: onProgress !== undefined };
    const values = [];
    if (gives) message.object = this.#queue.newId();
    if (keeps) Object.assign(message, { member, result: this.#queue.newId() });
    for (const place of at) {
      const value = valueAt(args, place);
      if (!isObject(value)) continue;
      const known = this.#results.get(value);
      message.args = withValueAt(message.args, place, known ? undefined : lean(value));
      if (!known) continue;
      const isMoved = buffersOf(value).some((buffer) => transfer.includes(buffer));
      message.subjects.push({ ...known, at: place, data: isMoved || !this.#queue.hasTwin(known.id) ? lean(value) : undefined });
      values.push(value);
    }
    return { message: copied(name, message, transfer), values };
  }
}
