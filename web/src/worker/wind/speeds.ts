import type { CellComplex } from 'mandoline-wasm/physics';
import type { Velocities } from './flows';

/** The speed at a point of a cell, in which the velocity is linear. */
export function speedIn({ cellCentroid }: CellComplex, { cellVelocity, cellGradient }: Velocities) {
  return (cell: number, px: number, py: number, pz: number): number => {
    const [x, y, z] = [px - cellCentroid[3 * cell], py - cellCentroid[3 * cell + 1], pz - cellCentroid[3 * cell + 2]];
    const g = 6 * cell; // xx, yy, zz, xy, yz, xz
    const u = cellVelocity[3 * cell] + cellGradient[g] * x + cellGradient[g + 3] * y + cellGradient[g + 5] * z;
    const v = cellVelocity[3 * cell + 1] + cellGradient[g + 3] * x + cellGradient[g + 1] * y + cellGradient[g + 4] * z;
    const w = cellVelocity[3 * cell + 2] + cellGradient[g + 5] * x + cellGradient[g + 4] * y + cellGradient[g + 2] * z;
    return Math.sqrt(u * u + v * v + w * w);
  };
}
