// physics-worker-thread.js, as in own-thread.js.
import { nodeThreadBeside, scriptBeside } from './beside.js';

const name = 'physics-worker-thread.js';

function start() {
  if (typeof Worker === 'function') return new Worker(new URL('./physics-worker-thread.js', import.meta.url), { type: 'module' });
  return nodeThreadBeside(name);
}

/** As ownThread. */
export const ownPhysicsThread = { source: () => ({ start, script: scriptBeside(name, 'own-physics-thread', import.meta.url) }) };
