// One kind of worker for browsers and Node: { post, terminate, hold }. While it is not held, Node's process may end.
import { MandolineError } from './errors.js';

function browserThread(worker, script, { onMessage, onDeath }) {
  worker.addEventListener('message', ({ data }) => onMessage(data));
  worker.addEventListener('messageerror', () => onDeath('its message could not be read'));
  worker.addEventListener('error', (event) => {
    event.preventDefault();
    onDeath(`its script ${event.filename || script} ${event.message ? `says: ${event.message}` : 'could not be loaded'}`);
  });
  return { post: (message, transfer) => worker.postMessage(message, transfer), terminate: () => worker.terminate(), hold() {} };
}

function nodeThread(worker, { onMessage, onDeath }) {
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

/** Starts a thread, with callbacks for its messages and its death. `start` gives its worker; error messages call its script `script`. */
export function startThread({ start, script }, handlers) {
  const worker = start();
  if (typeof worker?.on === 'function') return nodeThread(worker, handlers);
  if (typeof worker?.addEventListener === 'function') return browserThread(worker, script, handlers);
  throw new MandolineError('badArgument', 'options.thread must return a Worker.', { stage: 'init' });
}
