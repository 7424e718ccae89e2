// worker-thread.js, which lies beside this script. Apart from the WebAssembly, so that pages that start no worker are built without it.
import { nodeThreadBeside, scriptBeside } from './beside.js';

const name = 'worker-thread.js';

function start() {
  if (typeof Worker === 'function') return new Worker(new URL('./worker-thread.js', import.meta.url), { type: 'module' });
  return nodeThreadBeside(name, import.meta.url);
}

/**
 * Gives { start, script }, or a promise of it: what starts a worker, and what messages call its script.
 *
 * @type {{ source: () => any }}
 */
export const ownThread = { source: () => ({ start, script: scriptBeside(name, 'own-thread', import.meta.url) }) };
