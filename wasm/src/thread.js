// One kind of worker for browsers and Node: { post, terminate, hold }. While it is not held, Node's process may end.

function browserThread({ onMessage, onDeath }) {
  const worker = new Worker(new URL('./worker-thread.js', import.meta.url), { type: 'module' });
  worker.addEventListener('message', ({ data }) => onMessage(data));
  worker.addEventListener('messageerror', () => onDeath('its message could not be read'));
  worker.addEventListener('error', (event) => {
    event.preventDefault();
    onDeath(event.message || 'its script could not be loaded');
  });
  return { post: (message, transfer) => worker.postMessage(message, transfer), terminate: () => worker.terminate(), hold() {} };
}

function nodeThread(NodeWorker, { onMessage, onDeath }) {
  const script = './worker-thread.js'; // not a literal, since bundlers would take it for an asset
  const worker = new NodeWorker(new URL(script, import.meta.url), { execArgv: [] }); // those of the process may be for its own script only
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

/** Resolves to the function that starts a thread, given what to do with its messages and when it dies. */
export async function threadStarter() {
  if (typeof Worker === 'function') return browserThread;
  const threads = 'node:worker_threads'; // as above
  const { Worker: NodeWorker } = await import(/* @vite-ignore */ /* webpackIgnore: true */ threads);
  return (handlers) => nodeThread(NodeWorker, handlers);
}
