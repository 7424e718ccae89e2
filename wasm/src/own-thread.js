// worker-thread.js, which lies beside this script. Apart from the WebAssembly, so that pages that start no worker are built without it.
import { fileBeside } from './own-wasm.js';

function start() {
  if (typeof Worker === 'function') return new Worker(new URL('./worker-thread.js', import.meta.url), { type: 'module' });
  // No import, which bundlers for browsers would follow.
  const { Worker: NodeWorker } = globalThis.process.getBuiltinModule('node:worker_threads');
  return new NodeWorker(fileBeside('worker-thread.js'), { execArgv: [] }); // those of the process may be for its own script only
}

/** The address of the script; only its name where a bundler has put this code elsewhere and may have renamed the script. */
function script() {
  const isWherePacked = /^(?!file:).*\/own-thread\.js\b/.test(import.meta.url); // webpack writes the file that there was when it built
  return isWherePacked ? fileBeside('worker-thread.js') : 'worker-thread.js';
}

/** Gives { start, script }, or a promise of it: what starts a worker, and what messages call its script. */
export const ownThread = { source: () => ({ start, script: script() }) };
