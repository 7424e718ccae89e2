/**
 * The script of the package's workers. A script of your own that imports it answers the same calls, and others that it adds:
 *
 * ```js
 * // mine.js, started by createWorker({ thread: () => new Worker(new URL('./mine.js', import.meta.url), { type: 'module' }) })
 * import { serve } from 'mandoline-wasm/worker-thread';
 *
 * serve({
 *   cellVolumes(mandoline, [mesh, grid]) { // await worker.call('cellVolumes', [mesh, grid])
 *     return mandoline.measure(mesh, mandoline.cut(mesh, grid)).cellVolume;
 *   },
 * });
 * ```
 */
import type { Mandoline } from './index.js';

/**
 * A call beside the module: gets what the package's init() gives, a copy of the arguments, and a way to tell the page of its progress. The
 * value that it returns, or promises, is sent to the page, which its ArrayBuffers are transferred to. Jobs run one after another.
 */
export type ExtraCall = (mandoline: Mandoline, args: any, context: { progress(value: unknown): void }) => unknown;

/** Adds calls, by name, for `worker.call()`. The worker starts to answer when this module is imported. */
export function serve(calls?: Record<string, ExtraCall>): void;
