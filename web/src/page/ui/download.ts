import { inFileName } from '../../model/formats';
import type { Model } from '../../model/cut_model';

/** Saves a file that is named for the model, and for its grid or what else it is about. */
export function download(blob: Blob, { name, grid }: Model, extension: string, about = grid.cells.join('x')): void {
  saveAs(blob, inFileName(`${name}-${about}.${extension}`));
}

export function saveAs(blob: Blob, name: string): void {
  const url = URL.createObjectURL(blob);
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}
