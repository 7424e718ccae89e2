import { readFunction, readOptions } from './arguments.js';
import { Calls, callNames } from './calls.js';
import { named } from './errors.js';
import { JobQueue } from './jobs.js';
import { compile } from './load.js';
import { ownThread } from './own-thread.js';
import { startThread } from './thread.js';

export { MandolineError, describe } from './errors.js';

function readWorkerOptions(given) {
  const options = readOptions(given);
  readFunction(options.thread, 'options.thread');
  return options;
}

/** Starts a worker that has loaded the module. */
export async function createWorker(options) {
  const { wasm, thread } = named('init', readWorkerOptions)(options);
  const source = thread ? { start: thread, script: 'from options.thread' } : await ownThread.source();
  const queue = new JobQueue((handlers) => startThread(source, handlers), await compile(wasm));
  await queue.open();
  const calls = new Calls(queue);
  return {
    ...Object.fromEntries(callNames.map((name) => [name, (...given) => calls.own(name, given)])),
    call: (name, args = [], given = undefined) => calls.extra(String(name), args, given),
    terminate: () => queue.close(),
  };
}
