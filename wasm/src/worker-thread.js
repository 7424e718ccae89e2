// The worker's side of worker.js, and the script that it starts by default: starts the module that the page has compiled, then answers one
// job after another. In Node it is a worker thread.
import { laterCalls, startModule } from './api.js';
import { brickModule } from './bricks/module.js';
import { buffersOf } from './buffers.js';
import { MandolineError } from './errors.js';
import { fileModule } from './files/module.js';
import { cutModule } from './module.js';
import { suggestion } from './names.js';
import { parts } from './parts.js';
import { withValueAt } from './places.js';
import { Lead, follow } from './shares.js';
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

for (const module of [cutModule, fileModule, brickModule]) parts.set(module.name, module);

/** Answers jobs through `post`. */
class Answering {
  #post;
  #started = new Map(); // by name: { host, calls, shells } of modules
  #awaited = new Map(); // by name: { resolve, reject } of modules that the page was asked for
  #lead;
  #objects = new Map(); // of the page's, by the ids that it gives them

  constructor(post) {
    this.#post = post;
    this.#lead = new Lead(() => post({ type: 'share' }));
  }

  async answer(job) {
    try {
      if (job.forget !== undefined) for (const { shells } of this.#started.values()) shells.free(job.forget);
      else if (job.mate !== undefined) this.#takeMate(job);
      else if (job.free !== undefined) this.#free(job.free);
      else if (job.call === undefined) this.#take(job);
      else if (job.isExtra) this.#send(job, await this.#extra(job));
      else await this.#own(job);
    } catch (error) {
      this.#fail(error, job);
    }
  }

  #free(id) {
    this.#objects.get(id)?.free();
    this.#objects.delete(id);
    this.#post({ type: 'result' });
  }

  #objectOf({ id, type }) {
    if (!this.#objects.has(id)) throw new MandolineError('badArgument', `The ${type} is gone with its thread, which was ended.`);
    return this.#objects.get(id);
  }

  /** Another thread that takes shares of cuts, or its end. */
  #takeMate({ mate, port }) {
    if (port) this.#lead.add(mate, port);
    else this.#lead.remove(mate);
  }

  /**
   * A module from the page: that of cutting as the first job, others when they were asked for; or why there is none. `lead`: the port of the
   * thread to take shares from.
   */
  #take({ part = 'cut', module, error, lead }) {
    const awaited = this.#awaited.get(part);
    if (error) return awaited.reject(new MandolineError(error.code, error.message, error));
    const { host, calls } = startModule(parts.get(part), module, (name) => this.#module(name));
    this.#started.set(part, { host, calls, shells: new Shells(host) });
    if (lead) follow(lead, host);
    if (awaited) awaited.resolve();
    else this.#post({ type: 'result' });
  }

  async #module(name) {
    if (!parts.has(name))
      throw new MandolineError('badArgument', `The worker's script has to import mandoline-wasm/${name}/worker-thread.`);
    if (!this.#started.has(name)) {
      await new Promise((resolve, reject) => {
        this.#awaited.set(name, { resolve, reject });
        this.#post({ type: 'wanted', value: name });
      });
    }
    return this.#started.get(name);
  }

  async #own(job) {
    const { part, call, of, args, options, progress, subjects, result, member, object } = job;
    const module = await this.#module(part);
    const { host, calls, shells } = module;
    const found = subjects.map((subject) => this.#find(subject, part));
    const inputs = subjects.reduce((all, { at }, i) => withValueAt(all, at, found[i]), args);
    const given = progress ? { ...options, progress: (value) => this.#post({ type: 'progress', value }) } : options;
    try {
      const all = [...inputs, given];
      const run = of ? this.#objectOf(of)[call] : calls[call];
      const value = await (run === calls.cut ? this.#lead.cut(module, all) : run(...all));
      if (object !== undefined) this.#objects.set(object, value);
      const made = result === undefined ? undefined : memberOf(value, member);
      const results = [...subjects.map(({ id }, i) => [id, found[i]]), [result, made]];
      const kept = results.filter(([id, object]) => id !== undefined && host.hasTwin(object));
      this.#send(
        job,
        object === undefined ? value : undefined,
        kept.map(([id]) => id),
      );
      for (const [id, object] of kept) shells.keep(id, object);
    } catch (error) {
      const missing = subjects.filter(({ data }, i) => !data && !this.#hasTwin(found[i]));
      if (missing.length === 0 || error.code !== 'badArgument') throw error;
      this.#post({ type: 'missing', message: job, ids: missing.map(({ id }) => id) }, buffersOf([args, subjects]));
    }
  }

  /** The result that a message names by its id, if a module has its twin or its data come with the message; else nothing. */
  #find({ id, origin, data }, part) {
    const own = this.#started.get(part);
    for (const { host, shells } of [own, ...this.#started.values()]) {
      const shell = shells.find(id);
      if (host.hasTwin(shell)) return shell;
    }
    if (data) own.host.adopt(data, origin);
    return data;
  }

  #hasTwin(object) {
    return [...this.#started.values()].some(({ host }) => host.hasTwin(object));
  }

  async #extra({ call, args, progress }) {
    const run = extraCalls.get(call);
    if (!run) {
      const says = suggestion(call, [...extraCalls.keys()], 'it serves none');
      throw new MandolineError('badArgument', `The worker's script serves no call ${call}${says}`, { stage: call });
    }
    let tells = progress;
    try {
      return await run(this.#calls(), args, {
        progress: (value) => tells && this.#post({ type: 'progress', value }),
        cut: (...given) => this.#lead.cut(this.#started.get('cut'), given),
      });
    } finally {
      tells = false; // what it goes on with after its end is not the progress of the next call
    }
  }

  /** Those of all modules, for the extra calls; of modules that have not been started as promises. */
  #calls() {
    const later = (module) => laterCalls(module, () => this.#module(module.name));
    return Object.assign(
      {},
      ...[...parts.values()].map((module) => (module.name === 'cut' ? this.#started.get('cut').calls : later(module))),
    );
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
