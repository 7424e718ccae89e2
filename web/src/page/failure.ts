// What went wrong, as the page shows it.
import { describe, MandolineError } from 'mandoline-wasm/worker';
import { isLack, type CallName, type WindCallName } from '../model/calls';
import { isPageError, pageError, type PageError } from '../model/failure';

const titles: Record<CallName | WindCallName, string> = {
  load: "The mesh can't be read",
  loadAhead: "The readers can't be loaded",
  keep: "The mesh can't be kept",
  reuse: "Memory can't be used again",
  cut: "The mesh can't be cut",
  slice: "The cells can't be sliced",
  validate: "The cut-mesh can't be validated",
  edges: "The edges can't be counted",
  card: "The cell can't be shown",
  crossings: "The crossings can't be shown",
  compare: "The comparison can't be made",
  step: "The step can't be shown",
  write: "The file can't be written",
  writeMesh: "The mesh can't be written",
  end: "The thread can't be ended",
  wind: "The flow can't be computed",
  loadWind: "The wind tunnel can't be loaded",
  windAhead: "The flow can't be computed",
  turnAhead: "The flow can't be computed",
  smoke: "The smoke can't be computed",
  smokeStep: "The smoke can't be computed",
  writeWind: "The flow can't be written",
};

/** Of what was thrown anywhere. */
export function asPageError(error: unknown): PageError {
  return isPageError(error) ? error : pageError('Something went wrong', detailOf(error));
}

function detailOf(error: unknown): string {
  if (isLack(error)) return 'Another mesh has taken the place of its own.';
  return error instanceof Error ? error.message : String(error);
}

/** Of what a call of the worker threw. */
export function toPageError(error: unknown, call: CallName | WindCallName): PageError {
  if (isPageError(error)) return error;
  if (!(error instanceof MandolineError)) return pageError(titles[call], detailOf(error));
  return pageError(error.code === 'loadFailed' ? "The cutter can't be started" : titles[call], describe(error));
}

export function abortError(): DOMException {
  return new DOMException('Cancelled, or a newer call took its place.', 'AbortError');
}

/** Whether a call ended because it was stopped. */
export function isCancellation(error: unknown): boolean {
  return error instanceof MandolineError && error.code === 'cancelled';
}
