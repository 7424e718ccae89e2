import type { Mandoline } from 'mandoline-wasm';
import type { Checks } from '../model/checks';
import { gridCellVolume } from '../model/volumes';
import type { Cut } from './kept';

export async function checksOf(mandoline: Mandoline, cut: Cut): Promise<Checks> {
  const validation = await mandoline.validate(cut.mesh, cut.cutMesh);
  return { ...validation, volumeGap: volumeGap(mandoline, cut) };
}

/** The largest difference between the volume of a grid cell and that of its cut-cells together, as a fraction of the grid cell. */
function volumeGap(mandoline: Mandoline, cut: Cut): number {
  const { mesh, cutMesh } = cut;
  const { cells } = cutMesh.grid;
  cut.measures ??= mandoline.measure(mesh, cutMesh);
  const sums = new Map<number, number>();
  cut.measures.cellVolume.forEach((volume, cell) => {
    const at = cutMesh.cellGridCell.subarray(3 * cell, 3 * cell + 3);
    const gridCell = at[0] + cells[0] * (at[1] + cells[1] * at[2]);
    sums.set(gridCell, (sums.get(gridCell) ?? 0) + volume / gridCellVolume(cutMesh, at));
  });
  let worst = 0;
  for (const sum of sums.values()) worst = Math.max(worst, Math.abs(sum - 1));
  return worst;
}
