// The two files that the package loads at run time. They lie beside this one.

/** A worker with the package's script. */
function startWorker() {
  if (typeof Worker === 'function') return new Worker(new URL('./worker-thread.js', import.meta.url), { type: 'module' });
  // No import, which bundlers for browsers would follow.
  const { Worker: NodeWorker } = globalThis.process.getBuiltinModule('node:worker_threads');
  return new NodeWorker(fileBeside('worker-thread.js'), { execArgv: [] }); // those of the process may be for its own script only
}

/** A file beside this one, in Node; said so that bundlers don't take it for an asset of a page. */
export function fileBeside(name) {
  return new URL(import.meta.url.replace(/[^/]*$/, name));
}

/** Where the WebAssembly is, and what starts a worker. Either may be a promise. */
export const ownFiles = {
  wasm: () => new URL('./mandoline.wasm', import.meta.url),
  thread: () => startWorker,
};
