// worker-thread.js of this folder, as in ../own-thread.js.
import { nodeThreadBeside, scriptBeside } from '../beside.js';

const name = 'worker-thread.js';

function start() {
  if (typeof Worker === 'function') return new Worker(new URL('./worker-thread.js', import.meta.url), { type: 'module' });
  return nodeThreadBeside(name, import.meta.url);
}

/**
 * As ownThread.
 *
 * @type {{ source: () => any }}
 */
export const ownPhysicsThread = { source: () => ({ start, script: scriptBeside(name, 'own-thread', import.meta.url) }) };
