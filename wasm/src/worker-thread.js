// The worker's side of worker.js: starts the module that the page has compiled, then answers one job after another. In Node it is a
// worker thread.
import { makeApi } from './api.js';
import { buffersOf } from './buffers.js';
import { MandolineError } from './errors.js';

/** An error as plain data, since a clone of a MandolineError would lose all but its message. */
function plainError(error, call) {
  if (!(error instanceof MandolineError)) return { code: 'internalError', message: String(error?.message ?? error), stage: call };
  const { code, message, stage, element, element2 } = error;
  return { code, message, stage, element, element2 };
}

/** Answers a job through `post`. */
function answering(post) {
  let mandoline;

  const start = ({ module }) => {
    mandoline = makeApi(module);
    post({ type: 'result' });
  };

  const call = ({ call: name, args, options, progress }) => {
    if (progress) options.progress = (value) => post({ type: 'progress', value });
    const value = mandoline[name](...args, options);
    post({ type: 'result', value }, buffersOf(value));
  };

  return (job) => {
    try {
      if (job.call === 'init') start(job);
      else call(job);
    } catch (error) {
      post({ type: 'error', error: plainError(error, job.call) });
    }
  };
}

async function serve() {
  if (typeof postMessage === 'function') {
    const answer = answering((message, transfer = []) => postMessage(message, transfer));
    addEventListener('message', ({ data }) => answer(data));
  } else {
    const threads = 'node:worker_threads'; // not a literal, since bundlers for browsers would look for it
    const { parentPort } = await import(/* @vite-ignore */ /* webpackIgnore: true */ threads);
    parentPort.on('message', answering((message, transfer = []) => parentPort.postMessage(message, transfer)));
  }
}

serve();
