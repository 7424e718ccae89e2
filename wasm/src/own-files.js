// The two files that the package loads at run time. They lie beside this one.

/** A worker with the package's script. */
function startWorker() {
  if (typeof Worker === 'function') return new Worker(new URL('./worker-thread.js', import.meta.url), { type: 'module' });
  // Neither an import nor the address itself, since bundlers for browsers would follow both.
  const { Worker: NodeWorker } = globalThis.process.getBuiltinModule('node:worker_threads');
  const here = import.meta.url;
  return new NodeWorker(new URL('./worker-thread.js', here), { execArgv: [] }); // those of the process may be for its own script only
}

/** Where the WebAssembly is, and what starts a worker. Either may be a promise. */
export const ownFiles = {
  wasm: () => new URL('./mandoline.wasm', import.meta.url),
  thread: () => startWorker,
};
