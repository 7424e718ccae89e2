import { MandolineError } from './errors.js';

/**
 * Jobs done one after another by a thread, which is replaced when it has to be stopped or dies. A job is
 * { message, transfer, onProgress, resolve, reject }; the first job of every thread is to start the compiled module.
 */
export class JobQueue {
  #startThread;
  #module;
  #thread = null;
  #running = null;
  #waiting = [];
  #ended = false;

  constructor(startThread, module) {
    this.#startThread = startThread;
    this.#module = module;
  }

  /** Starts a thread; resolves when it has started the module. */
  open() {
    return new Promise((resolve, reject) => this.#launch(resolve, reject));
  }

  add(job) {
    if (this.#ended) return job.reject(new MandolineError('cancelled', 'The worker was terminated.', { stage: job.message.call }));
    this.#waiting.push(job);
    this.#next();
  }

  /** Rejects the job with the error: it leaves the queue or, if it runs, its thread is replaced. Nothing happens if the job is done. */
  stop(job, error) {
    if (this.#running === job) {
      this.#dismiss();
      job.reject(error);
      this.#launch();
    } else if (this.#waiting.includes(job)) {
      this.#waiting = this.#waiting.filter((other) => other !== job);
      job.reject(error);
    }
  }

  /** Ends the thread and all jobs. */
  close() {
    this.#ended = true;
    const jobs = [this.#running, ...this.#waiting].filter(Boolean);
    this.#dismiss();
    this.#waiting = [];
    for (const job of jobs) job.reject(new MandolineError('cancelled', 'The worker was terminated.', { stage: job.message.call }));
  }

  #launch(resolve = () => {}, reject = () => {}) {
    const isCurrent = () => this.#thread === thread;
    const job = {
      message: { call: 'init', module: this.#module },
      resolve,
      reject: (error) => {
        this.#dismiss();
        this.#waiting.splice(0).forEach((other) => other.reject(error));
        reject(error);
      },
    };
    let thread;
    try {
      thread = this.#startThread({
        onMessage: (message) => isCurrent() && this.#receive(message),
        onDeath: (reason) => isCurrent() && this.#mourn(reason),
      });
      this.#thread = thread;
      this.#perform(job);
    } catch (cause) {
      job.reject(cause instanceof MandolineError ? cause : loadFailure(cause.message, cause));
    }
  }

  #next() {
    if (this.#running || this.#ended) return;
    if (this.#waiting.length === 0) this.#thread?.hold(false);
    else if (this.#thread) this.#perform(this.#waiting.shift());
    else this.#launch();
  }

  #perform(job) {
    this.#running = job;
    this.#thread.hold(true);
    this.#thread.post(job.message, job.transfer);
  }

  #receive({ type, value, error }) {
    if (type === 'progress') this.#progress(value);
    else if (type === 'result') this.#settle((job) => job.resolve(value));
    else if (type === 'thrown') this.#settle((job) => job.reject(value));
    else this.#settle((job) => job.reject(new MandolineError(error.code, error.message, error)));
  }

  #progress(value) {
    const job = this.#running;
    try {
      if (job.onProgress(value) !== false) return;
      this.stop(job, new MandolineError('cancelled', 'The call was cancelled.', { stage: value?.stage ?? job.message.call }));
    } catch (error) {
      this.stop(job, error);
    }
  }

  #settle(settle) {
    const job = this.#running;
    this.#running = null;
    settle(job);
    this.#next();
  }

  /** After the thread died by itself. */
  #mourn(reason) {
    const job = this.#running;
    this.#dismiss();
    if (job?.message.call === 'init') job.reject(loadFailure(reason));
    else job?.reject(new MandolineError('internalError', `The worker died: ${reason}.`, { stage: job.message.call }));
    this.#next();
  }

  /** Lets go of the thread and of what it does. */
  #dismiss() {
    const thread = this.#thread;
    this.#thread = null;
    this.#running = null;
    thread?.terminate();
  }
}

function loadFailure(reason, cause) {
  return new MandolineError('loadFailed', `The worker could not be started: ${reason}.`, { stage: 'init', cause });
}
