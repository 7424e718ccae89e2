import { laterCalls, startModule, starter } from './api.js';
import { brickModule } from './bricks/module.js';
import { ownBrickWasm } from './bricks/own-wasm.js';
import { fileModule } from './files/module.js';
import { ownFileWasm } from './files/own-wasm.js';
import { compile, once } from './load.js';
import { cutModule } from './module.js';
import { ownWasm } from './own-wasm.js';

export { MandolineError, describe } from './errors.js';

const start = once(async ({ wasm = ownWasm.source, filesWasm = ownFileWasm.source, bricksWasm = ownBrickWasm.source }) => {
  const module = await compile(wasm, 'mandoline.wasm');
  const loadFiles = once(async () => startModule(fileModule, await compile(filesWasm, 'files.wasm')));
  const loadBricks = once(async () => startModule(brickModule, await compile(bricksWasm, 'bricks.wasm')));
  const later = { ...laterCalls(fileModule, loadFiles), ...laterCalls(brickModule, loadBricks) };
  return { module, api: { ...startModule(cutModule, module, loadFiles).calls, ...later } };
});

/**
 * Loads the WebAssembly module, once: every call gives the same promise, for any options. After a failure the next call tries again.
 */
export const init = starter('init', 'wasm', async (options) => (await start(options)).api);

/** The compiled module that init() used, to hand to init() in a worker of your own, or to createWorker(). */
export async function compiledModule() {
  await init();
  return (await start({})).module;
}
