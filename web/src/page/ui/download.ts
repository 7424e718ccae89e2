import type { Model } from '../../model/types';

/** Saves a file that is named for the model. */
export function download(blob: Blob, { name, grid }: Model, extension: string): void {
  const url = URL.createObjectURL(blob);
  const link = document.createElement('a');
  link.href = url;
  link.download = `${name}-${grid.cells.join('x')}.${extension}`.replaceAll(/[^\w.-]+/g, '-');
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}
