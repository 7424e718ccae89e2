// The worker's side of worker.js, and the script that it starts by default: starts the module that the page has compiled, then answers one
// job after another. In Node it is a worker thread.
import { makeApi } from './api.js';
import { buffersOf } from './buffers.js';
import { cutCalls } from './calls.js';
import { CutHost } from './cut-host.js';
import { MandolineError } from './errors.js';
import { suggestion } from './names.js';
import { parts } from './parts.js';
import { withValueAt } from './places.js';
import { memberOf } from './worker-calls.js';

const extraCalls = new Map();

/**
 * Adds calls to those that this worker answers. It answers from the moment this script is imported, in any script that
 * createWorker({ thread }) starts.
 */
export function serve(calls = {}) {
  for (const [name, call] of Object.entries(calls)) extraCalls.set(name, call);
}

/** By its name, since a script of the user's may have its class from another copy of the package. */
const isMandolineError = (error) => error?.name === 'MandolineError' && typeof error.code === 'string';

/** An error as plain data, since a clone of a MandolineError would lose all but its message. */
function plainError(error, call) {
  if (!isMandolineError(error)) return { code: 'internalError', message: String(error?.message ?? error), stage: call };
  const { code, message, stage, element, element2 } = error;
  return { code, message, stage: stage || call, element, element2 };
}

/**
 * The page's results that have twins here, by the ids that the page gives them. The page has their arrays; here each is an empty object, by
 * which the twin is found.
 */
class Shells {
  #host;
  #objects = new Map();

  constructor(host) {
    this.#host = host;
  }

  find(id) {
    return this.#objects.get(id);
  }

  /** Empties the object. */
  keep(id, object) {
    for (const key of Object.keys(object)) delete object[key];
    this.#objects.set(id, object);
    for (const [other, shell] of this.#objects) if (!this.#host.hasTwin(shell)) this.#objects.delete(other);
  }

  free(id) {
    this.#host.freeTwin(this.#objects.get(id));
    this.#objects.delete(id);
  }
}

parts.set('cut', (module) => {
  const host = new CutHost(module);
  return { host, calls: makeApi(host, cutCalls) };
});

/** Answers jobs through `post`. */
class Answering {
  #post;
  #parts = new Map(); // those that have been started: { host, calls, shells }

  constructor(post) {
    this.#post = post;
  }

  async answer(job) {
    try {
      if (job.module) this.#start(job);
      if (job.forget !== undefined) for (const { shells } of this.#parts.values()) shells.free(job.forget);
      else if (job.call === undefined) this.#post({ type: 'result' });
      else if (job.isExtra) this.#send(job, await this.#extra(job));
      else await this.#own(job);
    } catch (error) {
      this.#fail(error, job);
    }
  }

  #start({ part = 'cut', module }) {
    if (this.#parts.has(part)) return;
    const script = `mandoline-wasm/${part}/worker-thread`;
    if (!parts.has(part)) throw new MandolineError('badArgument', `The worker's script has to import ${script}.`);
    const { host, calls } = parts.get(part)(module);
    this.#parts.set(part, { host, calls, shells: new Shells(host) });
  }

  async #own(job) {
    const { part = 'cut', call, args, options, progress, subjects, result, member } = job;
    const { host, calls, shells } = this.#parts.get(part);
    const found = subjects.map((subject) => this.#find(subject, part));
    const inputs = subjects.reduce((all, { at }, i) => withValueAt(all, at, found[i]), args);
    const given = progress ? { ...options, progress: (value) => this.#post({ type: 'progress', value }) } : options;
    try {
      const value = await calls[call](...inputs, given);
      const made = result === undefined ? undefined : memberOf(value, member);
      const results = [...subjects.map(({ id }, i) => [id, found[i]]), [result, made]];
      const kept = results.filter(([id, object]) => id !== undefined && host.hasTwin(object));
      this.#send(job, value, [...kept.map(([id]) => id), part]);
      for (const [id, object] of kept) shells.keep(id, object);
    } catch (error) {
      const missing = subjects.filter(({ data }, i) => !data && !host.hasTwin(found[i]));
      if (missing.length === 0 || error.code !== 'badArgument') throw error;
      this.#post({ type: 'missing', message: job, ids: missing.map(({ id }) => id) }, buffersOf([args, subjects]));
    }
  }

  /** The result that a message names by its id, if its twin is here or its data come with the message; else nothing. */
  #find({ id, origin, data }, part) {
    const { host, shells } = this.#parts.get(part);
    const shell = shells.find(id);
    if (host.hasTwin(shell)) return shell;
    if (data) host.adopt(data, origin);
    return data;
  }

  #extra({ call, args, progress }) {
    const run = extraCalls.get(call);
    if (!run) {
      const says = suggestion(call, [...extraCalls.keys()], 'it serves none');
      throw new MandolineError('badArgument', `The worker's script serves no call ${call}${says}`, { stage: call });
    }
    return run(this.#parts.get('cut').calls, args, { progress: (value) => progress && this.#post({ type: 'progress', value }) });
  }

  #send({ call }, value, kept) {
    try {
      this.#post({ type: 'result', value, kept }, buffersOf(value));
    } catch (cause) {
      throw new MandolineError('internalError', `What the call gives can't be sent: ${cause.message}`, { stage: call, cause });
    }
  }

  /** What the package throws stays a MandolineError; what an extra call throws arrives as a clone. */
  #fail(error, job) {
    try {
      if (job.isExtra && !isMandolineError(error)) return this.#post({ type: 'thrown', value: error });
    } catch {} // that can't be cloned
    this.#post({ type: 'error', error: plainError(error, job.call) });
  }
}

function listen() {
  if (typeof postMessage === 'function' && typeof document === 'undefined') {
    const post = /** @type {any} */ (postMessage); // that of a worker
    const answering = new Answering((message, transfer = []) => post(message, transfer));
    addEventListener('message', ({ data }) => answering.answer(data));
  } else if (globalThis.process?.versions?.node) {
    // No import, which bundlers for browsers would follow.
    const { parentPort } = globalThis.process.getBuiltinModule('node:worker_threads');
    const answering = new Answering((message, transfer = []) => parentPort.postMessage(message, transfer));
    parentPort?.on('message', (job) => answering.answer(job));
  }
}

listen();
