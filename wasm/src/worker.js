import { readFunction, readOptions } from './arguments.js';
import { buffersOf, clone } from './buffers.js';
import { MandolineError, named } from './errors.js';
import { JobQueue } from './jobs.js';
import { compile } from './load.js';
import { ownFiles } from './own-files.js';
import { startThread } from './thread.js';

export { MandolineError, describe } from './errors.js';

/** The calls with their numbers of arguments before the options. */
const calls = { cut: 2, validate: 2, measure: 2, cutEdges: 2, adjacency: 1, triangulate: 2, cellAt: 2, cellsAt: 2, slice: 2, write: 3, readMesh: 1 };

const isObject = (value) => typeof value === 'object' && value !== null;

/** The options of the call itself, and those that stay here. */
function splitOptions(options = {}) {
  if (!isObject(options)) return { options }; // the call says what it is not
  const { signal, transfer = [], ...own } = options;
  if (typeof own.progress !== 'function') return { signal, transfer, options: own };
  const { progress, ...rest } = own;
  return { signal, transfer, onProgress: progress, options: rest };
}

/** A cut-mesh without gridCellRegion, which no call reads and which may be large. */
function lean(argument) {
  if (!isObject(argument) || !('gridCellRegion' in argument)) return argument;
  const { gridCellRegion, ...rest } = argument;
  return rest;
}

/** A message with a copy of the arguments as they are now, so that neither the queue nor the worker sees later changes. */
function makeMessage({ call, args, extra }, { options, onProgress, signal, transfer }) {
  if (signal !== undefined && !(signal instanceof AbortSignal)) {
    throw new MandolineError('badArgument', 'options.signal must be an AbortSignal.', { stage: call });
  }
  if (!Array.isArray(args)) throw new MandolineError('badArgument', 'The arguments of a call must be an array.', { stage: call });
  try {
    const sent = extra ? args : args.map(lean);
    return clone({ call, extra, args: sent, options, progress: onProgress !== undefined }, transfer);
  } catch (cause) {
    throw new MandolineError('badArgument', `The arguments can't be given to the worker: ${cause.message}`, { stage: call, cause });
  }
}

function perform(queue, asked, given) {
  const { call } = asked;
  return new Promise((resolve, reject) => {
    const split = splitOptions(given);
    const { signal, onProgress } = split;
    const cancellation = () => new MandolineError('cancelled', 'The call was cancelled.', { stage: call, cause: signal.reason });
    if (signal?.aborted) throw cancellation();
    const message = makeMessage(asked, split);
    const abort = () => queue.stop(job, cancellation());
    const settled = (settle) => (value) => {
      signal?.removeEventListener('abort', abort);
      settle(value);
    };
    const transfer = buffersOf(message.args); // of the copies: they go on to the worker
    const job = { message, transfer, onProgress, resolve: settled(resolve), reject: settled(reject) };
    signal?.addEventListener('abort', abort);
    queue.add(job);
  });
}

function readWorkerOptions(given) {
  const options = readOptions(given);
  readFunction(options.thread, 'options.thread');
  return options;
}

/** Starts a worker that has loaded the module. */
export async function createWorker(options) {
  const { wasm, thread } = named('init', readWorkerOptions)(options);
  const make = thread ?? (await ownFiles.thread());
  const queue = new JobQueue((handlers) => startThread(make, handlers), await compile(wasm));
  await queue.open();
  const methods = Object.entries(calls).map(([call, count]) => [
    call, (...given) => perform(queue, { call, args: Array.from({ length: count }, (_, i) => given[i]) }, given[count]),
  ]);
  return {
    ...Object.fromEntries(methods),
    call: (name, args = [], options = undefined) => perform(queue, { call: String(name), args, extra: true }, options),
    terminate: () => queue.close(),
  };
}
