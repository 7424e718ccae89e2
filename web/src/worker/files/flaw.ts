import type { PageError } from '../../model/types';

/** What is wrong with a file, and where. */
export class Flaw extends Error {}

/** A file that can't be read. */
export class FileError extends Error implements PageError {
  readonly title: string;
  readonly detail: string;

  constructor(name: string, detail: string) {
    super(`${name} can't be read. ${detail}`);
    this.title = `${name} can't be read`;
    this.detail = detail;
  }
}

/** What a file says at some place, short enough to show. */
export function quoted(text: string): string {
  return text.length > 40 ? `"${text.slice(0, 37)}…"` : `"${text}"`;
}
