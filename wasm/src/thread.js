// One kind of worker for browsers and Node: { post, terminate, hold }. While it is not held, Node's process may end.
import { MandolineError } from './errors.js';

function browserThread({ worker, script }, { onMessage, onDeath }) {
  worker.addEventListener('message', ({ data }) => onMessage(data));
  worker.addEventListener('messageerror', () => onDeath('its message could not be read'));
  worker.addEventListener('error', (event) => {
    event.preventDefault();
    onDeath(`its script ${event.filename || script || ''} ${event.message ? `says: ${event.message}` : 'could not be loaded'}`);
  });
  return { post: (message, transfer) => worker.postMessage(message, transfer), terminate: () => worker.terminate(), hold() {} };
}

function nodeThread({ worker }, { onMessage, onDeath }) {
  worker.on('message', onMessage);
  worker.on('messageerror', (error) => onDeath(error.message));
  worker.on('error', (error) => onDeath(error.message));
  worker.on('exit', (code) => onDeath(`it ended with code ${code}`));
  return {
    post: (message, transfer) => worker.postMessage(message, transfer),
    terminate: () => void worker.terminate(),
    hold: (held) => (held ? worker.ref() : worker.unref()),
  };
}

/** What make() starts, and the address of its script: bundlers change that, so that only the constructor knows it. */
function noteScript(make) {
  const Original = globalThis.Worker;
  if (typeof Original !== 'function') return { worker: make() };
  let script;
  globalThis.Worker = class extends Original {
    constructor(address, ...rest) {
      super(address, ...rest);
      script = address;
    }
  };
  try {
    return { worker: make(), script };
  } finally {
    globalThis.Worker = Original;
  }
}

/** Starts a thread, given what to do with its messages and when it dies. `make` starts its worker. */
export function startThread(make, handlers) {
  const made = noteScript(make);
  const { worker } = made;
  if (typeof worker?.on === 'function') return nodeThread(made, handlers);
  if (typeof worker?.addEventListener === 'function') return browserThread(made, handlers);
  throw new MandolineError('badArgument', 'options.thread must return a Worker.', { stage: 'init' });
}
