/**
 * The script of the package's workers. A script of your own that imports it answers the same calls, and others that it adds:
 *
 * ```js
 * // mine.js, started by createWorker({ thread: () => new Worker(new URL('./mine.js', import.meta.url), { type: 'module' }) })
 * import { serve } from 'mandoline-wasm/worker-thread';
 *
 * serve({
 *   async cellVolumes(mandoline, [mesh, grid], { cut }) { // await worker.call('cellVolumes', [mesh, grid])
 *     return mandoline.measure(mesh, await cut(mesh, grid)).cellVolume;
 *   },
 * });
 * ```
 */
import type { CutMesh, CutOptions, GridInput, Mandoline, Mesh } from './index.js';

export interface ExtraCallContext {
  /** Tells the page of the call's progress. */
  progress(value: unknown): void;
  /** As the cut() of the module, which one thread makes: all that createWorker({ threads }) has share this one where it is large enough. */
  cut(mesh: Mesh, grid: GridInput, options?: CutOptions): Promise<CutMesh>;
}

/**
 * A call beside the module: gets what the package's init() gives, a copy of the arguments, and what the worker does for it. The value that
 * it returns, or promises, is sent to the page, which its ArrayBuffers are transferred to. Jobs run one after another.
 */
export type ExtraCall = (mandoline: Mandoline, args: any, context: ExtraCallContext) => unknown;

/** Adds calls, by name, for `worker.call()`. The worker starts to answer when this module is imported. */
export function serve(calls?: Record<string, ExtraCall>): void;
