import { makeApi } from './api.js';
import { readStart } from './arguments.js';
import { cutCalls } from './calls.js';
import { CutHost } from './cut-host.js';
import { named } from './errors.js';
import { compile } from './load.js';
import { ownWasm } from './own-wasm.js';

export { MandolineError, describe } from './errors.js';

let started;

async function start({ wasm = ownWasm.source }) {
  const module = await compile(wasm, 'mandoline.wasm');
  return { module, api: makeApi(new CutHost(module), cutCalls) };
}

function begin(given) {
  const options = named('init', readStart)(given, 'wasm');
  if (!started) {
    const attempt = start(options);
    started = { attempt, api: attempt.then(({ api }) => api) };
    started.api.catch(() => {
      started = undefined;
    });
  }
  return started;
}

/**
 * Loads the WebAssembly module, once: every call gives the same promise, for any options. After a failure the next call tries again.
 */
export function init(options) {
  try {
    return begin(options).api;
  } catch (error) {
    return Promise.reject(error);
  }
}

/** The compiled module that init() used, to hand to init() in a worker of your own, or to createWorker(). */
export async function compiledModule() {
  return (await begin().attempt).module;
}
