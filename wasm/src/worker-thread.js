// The worker's side of worker.js, and the script that it starts by default: starts the module that the page has compiled, then answers one
// job after another. In Node it is a worker thread.
import { makeApi } from './api.js';
import { buffersOf } from './buffers.js';
import { MandolineError } from './errors.js';

const extraCalls = new Map();

/**
 * Adds calls to those that this worker answers. The worker does so from when this script is imported, in any script that
 * createWorker({ thread }) starts.
 */
export function serve(calls = {}) {
  for (const [name, call] of Object.entries(calls)) extraCalls.set(name, call);
}

/** An error as plain data, since a clone of a MandolineError would lose all but its message. */
function plainError(error, call) {
  if (!(error instanceof MandolineError)) return { code: 'internalError', message: String(error?.message ?? error), stage: call };
  const { code, message, stage, element, element2 } = error;
  return { code, message, stage: stage || call, element, element2 };
}

/** Answers jobs through `post`. */
class Answering {
  #post;
  #mandoline;

  constructor(post) {
    this.#post = post;
  }

  async answer(job) {
    try {
      await (job.call === 'init' && !job.extra ? this.#start(job) : this.#call(job));
    } catch (error) {
      this.#fail(error, job);
    }
  }

  #start({ module }) {
    this.#mandoline = makeApi(module);
    this.#post({ type: 'result' });
  }

  async #call(job) {
    const value = await (job.extra ? this.#extra(job) : this.#own(job));
    try {
      this.#post({ type: 'result', value }, buffersOf(value));
    } catch (cause) {
      throw new MandolineError('internalError', `What the call gives can't be sent: ${cause.message}`, { stage: job.call, cause });
    }
  }

  #own({ call, args, options, progress }) {
    if (progress) options.progress = (value) => this.#post({ type: 'progress', value });
    return this.#mandoline[call](...args, options);
  }

  #extra({ call, args, progress }) {
    const run = extraCalls.get(call);
    if (!run) throw new MandolineError('badArgument', `The worker's script serves no call "${call}".`, { stage: call });
    return run(this.#mandoline, args, { progress: (value) => progress && this.#post({ type: 'progress', value }) });
  }

  /** What the package throws stays a MandolineError; what an extra call throws arrives as a clone. */
  #fail(error, job) {
    try {
      if (job.extra && !(error instanceof MandolineError)) return this.#post({ type: 'thrown', value: error });
    } catch {} // that can't be cloned
    this.#post({ type: 'error', error: plainError(error, job.call) });
  }
}

function listen() {
  if (typeof postMessage === 'function' && typeof document === 'undefined') {
    const answering = new Answering((message, transfer = []) => postMessage(message, transfer));
    addEventListener('message', ({ data }) => answering.answer(data));
  } else if (globalThis.process?.versions?.node) {
    const { parentPort } = globalThis.process.getBuiltinModule('node:worker_threads'); // no import, which bundlers for browsers would follow
    const answering = new Answering((message, transfer = []) => parentPort.postMessage(message, transfer));
    parentPort?.on('message', (job) => answering.answer(job));
  }
}

listen();
