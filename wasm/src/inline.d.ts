/**
 * The package's other files within JavaScript, for `init(inline)` and `createWorker(inline)`: nothing is left to serve or to copy.
 *
 * ```js
 * import { init } from 'mandoline-wasm';
 * import * as inline from 'mandoline-wasm/inline';
 * const { cut } = await init(inline);
 * ```
 */
import type { Thread } from './worker.js';

/** The bytes of mandoline.wasm. */
export function wasm(): Promise<ArrayBuffer>;

/** The bytes of files.wasm. */
export function filesWasm(): Promise<ArrayBuffer>;

/** The bytes of bricks.wasm. */
export function bricksWasm(): Promise<ArrayBuffer>;

/** Starts the worker's script. In browsers it is a blob, which a content security policy allows by `worker-src blob:`. */
export function thread(): Thread;
