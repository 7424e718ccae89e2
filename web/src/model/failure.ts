/** An error to show: what is wrong and where. */
export interface PageError {
  title: string;
  detail: string;
}

export function pageError(title: string, detail: string): PageError {
  return { title, detail };
}

export function isPageError(error: unknown): error is PageError {
  return typeof error === 'object' && error !== null && 'title' in error && 'detail' in error;
}

/** Whether it was given up, since it was cancelled or something newer took its place. */
export function isAbort(error: unknown): boolean {
  return error instanceof Error && error.name === 'AbortError';
}

/** What is said of a file that can't be read. */
export function fileError(name: string, detail: string): PageError {
  return pageError(`${name} can't be read`, detail);
}
