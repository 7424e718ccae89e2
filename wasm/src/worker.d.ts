/** The same calls as promises, in a module worker: the page stays responsive. Browsers and Node. */
import type { InitOptions } from './index.js';
import type { WorkerCalls as FileCalls } from './files/signatures.js';
import type { WorkerCalls } from './signatures.js';

export { MandolineError, describe } from './index.js';

export interface CallOptions {
  /** Aborting ends the call with a MandolineError with code "cancelled": one that waits leaves the queue, one that runs is stopped. */
  signal?: AbortSignal;
  /** Buffers of the arguments to hand over instead of copying; the caller can't use them afterwards. */
  transfer?: ArrayBuffer[];
}

export interface ExtraCallOptions extends CallOptions {
  /** Gets what the call tells of its progress; returning false cancels the call. */
  progress?: (value: any) => boolean | void;
}

/**
 * Calls run one after another, in the order they were made. Results are transferred, not copied; the twins of those of cut() and prepare()
 * stay in the thread (see CutMesh).
 */
export interface MandolineWorker extends WorkerCalls, FileCalls {
  /**
   * Runs a call that the thread's own script serves (see `serve` of `mandoline-wasm/worker-thread`) with a copy of the arguments, in the
   * same queue as the others. What it throws is what the promise is rejected with, as a clone.
   */
  call<Result = unknown>(name: string, args?: readonly unknown[], options?: ExtraCallOptions): Promise<Result>;
  /** Ends the worker; calls under way are rejected with code "cancelled". */
  terminate(): void;
}

/** A module worker of browsers or a worker thread of Node. */
export interface Thread {
  postMessage(message: any, transfer?: any): void;
  terminate(): unknown;
}

export interface WorkerOptions extends InitOptions {
  /**
   * Starts a worker with a script of your own, which imports `mandoline-wasm/worker-thread` and may add calls to it:
   * `() => new Worker(new URL('./mine.js', import.meta.url), { type: 'module' })`. Called again whenever the thread has to be replaced,
   * because a call that ran was cancelled or the thread died.
   */
  thread?: () => Thread;
}

/** Starts a worker that has loaded the module. Code "loadFailed", naming the script that failed, if it can't. */
export function createWorker(options?: WorkerOptions): Promise<MandolineWorker>;
