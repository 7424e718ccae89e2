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

/** What starts the package's own script. */
async function ownWorker() {
  if (typeof Worker === 'function') return () => new Worker(new URL('./worker-thread.js', import.meta.url), { type: 'module' });
  const threads = 'node:worker_threads'; // not a literal, since bundlers for browsers would look for it
  const { Worker: NodeWorker } = await import(/* @vite-ignore */ /* webpackIgnore: true */ threads);
  const script = './worker-thread.js'; // as above: they would take it for an asset
  return () => new NodeWorker(new URL(script, import.meta.url), { execArgv: [] }); // those of the process may be for its own script only
}

/** Resolves to the function that starts a thread, given what to do with its messages and when it dies. `make` starts a worker. */
export async function threadStarter(make) {
  const start = make ?? (await ownWorker());
  return (handlers) => {
    const made = noteScript(start);
    const { worker } = made;
    if (typeof worker?.on === 'function') return nodeThread(made, handlers);
    if (typeof worker?.addEventListener === 'function') return browserThread(made, handlers);
    throw new MandolineError('badArgument', 'options.thread must return a Worker.', { stage: 'init' });
  };
}
