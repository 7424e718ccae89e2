import { cutCalls } from './calls.js';
import { JobQueue } from './jobs.js';
import { compile } from './load.js';
import { startThread } from './thread.js';
import { Calls } from './worker-calls.js';

/**
 * Starts a worker that has loaded the module, by `thread` or else as `own` says. moreCalls() gives calls beside those.
 *
 * @param {{ wasm: unknown, thread?: () => unknown }} options
 * @param {{ source: () => any }} own
 * @param {(queue: JobQueue, calls: Calls) => object} [moreCalls]
 */
export async function openWorker({ wasm, thread }, own, moreCalls = () => ({})) {
  const source = thread ? { start: thread, script: 'from options.thread' } : await own.source();
  const queue = new JobQueue((handlers) => startThread(source, handlers), await compile(wasm, 'mandoline.wasm'));
  await queue.open();
  const calls = new Calls(queue, cutCalls);
  return {
    ...calls.all(),
    ...moreCalls(queue, calls),
    call: (name, args = [], given = undefined) => calls.extra(String(name), args, given),
    terminate: () => queue.close(),
  };
}
