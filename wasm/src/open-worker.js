import { brickCalls } from './bricks/calls.js';
import { ownBrickWasm } from './bricks/own-wasm.js';
import { cutCalls } from './calls.js';
import { startCrew } from './crew.js';
import { fileCalls } from './files/calls.js';
import { ownFileWasm } from './files/own-wasm.js';
import { JobQueue } from './jobs.js';
import { compile, once } from './load.js';
import { ownWasm } from './own-wasm.js';
import { Calls } from './worker-calls.js';

/**
 * Starts a worker that has loaded the module of `wasm`, by `thread` or else as `own` says, of up to `threads` threads. `more`: a module,
 * beside those of all workers, that it loads when one of their calls is first made.
 *
 * @param {{ wasm?: unknown, filesWasm?: unknown, bricksWasm?: unknown, thread?: () => unknown, threads: number }} options
 * @param {{ source: () => any }} own
 * @param {{ name: string, calls: object, source: unknown }[]} more
 */
export async function openWorker(options, own, ...more) {
  const { wasm = ownWasm.source, filesWasm = ownFileWasm.source, bricksWasm = ownBrickWasm.source, thread, threads } = options;
  const source = thread ? { start: thread, script: 'from options.thread' } : await own.source();
  const later = [
    { name: 'files', calls: fileCalls, source: filesWasm },
    { name: 'bricks', calls: brickCalls, source: bricksWasm },
    ...more,
  ];
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
