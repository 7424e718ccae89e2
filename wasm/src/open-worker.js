import { cutCalls } from './calls.js';
import { fileCalls } from './files/calls.js';
import { JobQueue } from './jobs.js';
import { startCrew } from './crew.js';
import { compile, once } from './load.js';
import { Calls } from './worker-calls.js';

/**
 * Starts a worker that has loaded the module of `wasm`, by `thread` or else as `own` says, of up to `threads` threads. `more`: the modules,
 * beside that of `filesWasm`, that it loads when one of their calls is first made.
 *
 * @param {{ wasm: unknown, filesWasm: unknown, thread?: () => unknown, threads: number }} options
 * @param {{ source: () => any }} own
 * @param {{ name: string, calls: object, source: unknown }[]} [more]
 */
export async function openWorker({ wasm, filesWasm, thread, threads }, own, more = []) {
  const source = thread ? { start: thread, script: 'from options.thread' } : await own.source();
  const later = [{ name: 'files', calls: fileCalls, source: filesWasm }, ...more];
  const modules = new Map(later.map((module) => [module.name, once(() => compile(module.source, `${module.name}.wasm`))]));
  const compiled = await compile(wasm, 'mandoline.wasm');
  const start = (handlers) => startCrew(source, handlers, { count: threads, module: compiled });
  const queue = new JobQueue(start, compiled, modules);
  await queue.open();
  const calls = new Calls(queue, [{ name: 'cut', calls: cutCalls }, ...later]);
  return {
    ...calls.all(),
    call: (name, args = [], given = undefined) => calls.extra(String(name), args, given),
    terminate: () => queue.close(),
  };
}
