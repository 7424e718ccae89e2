import { describe, MandolineError } from 'mandoline-wasm';
import type { PageError } from './types';
import type { CallName } from './protocol';

const titles: Record<CallName, string> = {
  load: "The mesh can't be read",
  cut: "The mesh can't be cut",
  slice: "The cells can't be sliced",
  validate: "The cut-mesh can't be validated",
  card: "The cell can't be shown",
  step: "The step can't be shown",
  write: "The file can't be written",
};

export function pageError(title: string, detail: string): PageError {
  return { title, detail };
}

export function isPageError(error: unknown): error is PageError {
  return typeof error === 'object' && error !== null && 'title' in error && 'detail' in error;
}

/** What went wrong in a call, as the page shows it. */
export function toPageError(error: unknown, call: CallName): PageError {
  if (isPageError(error)) return pageError(error.title, error.detail);
  if (error instanceof MandolineError) return pageError(titles[call], describe(error));
  return pageError(titles[call], error instanceof Error ? error.message : String(error));
}

export function abortError(): DOMException {
  return new DOMException('Cancelled, or a newer call took its place.', 'AbortError');
}
