import { MandolineError } from './errors.js';

/**
 * Jobs done one after another by a thread, which is replaced when it has to be stopped or dies. A job is
 * { call, isCut, message, pack, onProgress, resolve, reject }: pack(message, twins) gives { message, transfer } for a thread that has these
 * twins of results, by their ids. The first job of every thread is to start the compiled module; others are sent when it asks for them.
 */
export class JobQueue {
  #startThread;
  #module;
  #later;
  #thread = null;
  #twins = new Set(); // in the thread, as far as is known here
  #running = null;
  #waiting = [];
  #ended = false;
  #count = 0;

  /** `later`: by name what promises another module. */
  constructor(startThread, module, later) {
    this.#startThread = startThread;
    this.#module = module;
    this.#later = later;
  }

  /** Starts a thread; resolves when it has started the module. */
  open() {
    return new Promise((resolve, reject) => this.#launch(resolve, reject));
  }

  add(job) {
    if (this.#ended) return job.reject(new MandolineError('cancelled', 'The worker was terminated.', { stage: job.call }));
    this.#waiting.push(job);
    this.#next();
  }

  /** A new id for a result. */
  newId() {
    return ++this.#count;
  }

  hasTwin(id) {
    return this.#twins.has(id);
  }

  freeTwin(id) {
    if (this.#twins.delete(id)) this.#thread.post({ forget: id });
  }

  /** Once all jobs are done that were added before. */
  freeObject(id) {
    if (this.#thread) this.add({ call: 'free', message: { free: id }, pack: (message) => ({ message }), resolve() {}, reject() {} });
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
    for (const job of jobs) job.reject(new MandolineError('cancelled', 'The worker was terminated.', { stage: job.call }));
  }

  /**
   * @param {(outcome?: unknown) => void} [resolve]
   * @param {(error: unknown) => void} [reject]
   */
  #launch(resolve = () => {}, reject = () => {}) {
    const isCurrent = () => this.#thread === thread;
    const job = {
      call: 'init',
      message: { module: this.#module },
      pack: (message) => ({ message }),
      resolve,
      reject: (cause) => {
        const error = cause instanceof MandolineError ? cause : loadFailure(cause.message, cause);
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
      job.reject(cause);
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
    try {
      const { message, transfer } = job.pack(job.message, this.#twins);
      this.#thread.post(message, transfer);
    } catch (error) {
      this.#settle(() => job.reject(error));
    }
  }

  #receive({ type, value, kept, error, message, ids }) {
    if (type === 'progress') this.#progress(value);
    else if (type === 'wanted') this.#send(value);
    else if (type === 'missing') this.#repeat(message, ids);
    else if (type === 'result') this.#settle((job) => this.#resolve(job, value, kept));
    else if (type === 'thrown') this.#settle((job) => job.reject(value));
    else this.#settle((job) => job.reject(new MandolineError(error.code, error.message, error)));
  }

  /** Sends a module that the thread asks for, or why there is none. */
  async #send(part) {
    const thread = this.#thread;
    const answer = await this.#later
      .get(part)()
      .then(
        (module) => ({ part, module }),
        ({ code, message, stage }) => ({ part, error: { code, message, stage } }),
      );
    if (this.#thread === thread) thread.post(answer);
  }

  #resolve(job, value, kept = []) {
    for (const id of kept) this.#twins.add(id);
    job.resolve(value);
  }

  /** After the thread gave the message back, because it no longer has twins that this names by these ids. */
  #repeat(message, ids) {
    for (const id of ids) this.#twins.delete(id);
    this.#running.message = message;
    this.#perform(this.#running);
  }

  #progress(value) {
    const job = this.#running;
    try {
      if (job.onProgress(value) !== false) return;
      this.stop(job, new MandolineError('cancelled', 'The call was cancelled.', { stage: job.isCut ? value.stage : job.call }));
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
    if (job?.call === 'init') job.reject(loadFailure(reason));
    else job?.reject(new MandolineError('internalError', `The worker died: ${reason}.`, { stage: job.call }));
    this.#next();
  }

  /** Drops the thread and its job. */
  #dismiss() {
    const thread = this.#thread;
    this.#thread = null;
    this.#running = null;
    this.#twins.clear();
    thread?.terminate();
  }
}

function loadFailure(reason, cause) {
  return new MandolineError('loadFailed', `The worker could not be started: ${reason}.`, { stage: 'init', cause });
}
