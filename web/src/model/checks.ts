// What is said of the checks of a cut-mesh.
import type { Validation } from 'mandoline-wasm';
import { integer } from './format';

export interface Checks extends Validation {
  /** How far the volumes of the cut-cells of a grid cell together are off at most, as a fraction of the grid cell. */
  volumeGap: number;
}

/** Cut-meshes with more cut-faces are checked when that is asked for: a cut that comes meanwhile waits for about 0.1 s at most. */
export const mostFacesUnasked = 14_000;

/** For example "All 1,234 cut-cells are closed; their volumes fill their grid cells within 3e-16 of a cell."; null if there are none. */
export function checksSentence({ pass, checks, volumeGap }: Checks, cutCells: number): string | null {
  const failed = checks.filter((check) => !check.pass);
  if (!pass) return `${failed.length} of ${checks.length} checks failed. ${failed[0]?.message ?? ''}`.trim();
  if (cutCells === 0) return null;
  const within = volumeGap === 0 ? ' exactly' : ` within ${volumeGap.toPrecision(1)} of a cell`;
  if (cutCells === 1) return `The only cut-cell is closed; its volume fills its grid cell${within}.`;
  return `All ${integer(cutCells)} cut-cells are closed; their volumes fill their grid cells${within}.`;
}
