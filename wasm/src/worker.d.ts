/** The same calls as promises, in a module worker: the page stays responsive. Browsers and Node. */
/// <reference lib="esnext.disposable" />
import type { InitOptions } from './index.js';
import type { WorkerCalls as BrickCalls } from './bricks/signatures.js';
import type { WorkerCalls as FileCalls } from './files/signatures.js';
import type { WorkerCalls } from './signatures.js';

export { MandolineError, describe } from './index.js';

export interface CallOptions {
  /** Aborting ends the call with a MandolineError with code "cancelled": one that waits leaves the queue, one that runs is stopped. */
  signal?: AbortSignal;
  /** Buffers of the arguments to hand over instead of copying; the caller can't use them afterwards. */
  transfer?: ArrayBuffer[];
}

/** A method's arguments; its options, where it has some that can tell of progress, may have those of every call, too. */
type WithCallOptions<Given extends unknown[]> =
  | Given
  | (Required<Given> extends [...infer First, infer Own]
      ? 'progress' extends keyof Own
        ? [...given: First, options: Own & CallOptions]
        : never
      : never);

/** An object whose state is in the worker's thread: its methods are promises. If a running call is cancelled, the state is lost. */
export type OnWorker<T> = {
  [K in keyof T]: K extends 'free' | typeof Symbol.dispose
    ? T[K]
    : T[K] extends (...given: infer Given) => infer Value
      ? (...given: WithCallOptions<Given>) => Promise<Value>
      : T[K];
};

export interface ExtraCallOptions extends CallOptions {
  /** Gets what the call tells of its progress; returning false cancels the call. */
  progress?: (value: any) => boolean | void;
}

/**
 * Calls run one after another, in the order they were made. Results are transferred, not copied; the twins of those of cut() and prepare()
 * stay in the thread (see CutMesh).
 */
export interface MandolineWorker extends WorkerCalls, FileCalls, BrickCalls {
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
  /**
   * How many threads there may be, from 1 (default) to 64: the first large cut starts all but one. They need no shared memory, and so no
   * headers of the server: each has a copy of the mesh and cuts some layers of the grid. Only cut() is shared, where it is large enough and
   * has no snapTolerance; the result is the same, to the bit. Calls of a script of your own share it, too (see ExtraCallContext).
   */
  threads?: number;
}

/** Starts a worker that has loaded the module. Code "loadFailed", naming the script that failed, if it can't. */
export function createWorker(options?: WorkerOptions): Promise<MandolineWorker>;
