// What tests of workers share.
import assert from 'node:assert/strict';
import { MandolineError, createWorker } from 'mandoline-wasm/worker';

/** Runs f with a worker that is terminated afterwards. */
export async function withWorker(f, options) {
  const worker = await createWorker(options);
  try {
    return await f(worker);
  } finally {
    worker.terminate();
  }
}

/** The MandolineError that a promise is rejected with. */
export async function rejection(promise) {
  const error = await promise.then(
    () => assert.fail('should have been rejected'),
    (reason) => reason,
  );
  assert.ok(error instanceof MandolineError, `${error?.stack}`);
  return error;
}

/** A cut-mesh, times and counters aside. */
export const withoutStats = ({ stats, ...rest }) => rest;
