// The cells that smoke is computed on.
import type { Bounds } from './grid_around';
import type { Vector3 } from './vector';

/** Grid cells along the longest side of the mesh. */
const resolution = 16;
/** Of the box around the mesh, in its longest sides: against the wind, beside it, and where the wind blows to. */
const margins = { before: 0.45, beside: 0.5, behind: 1.5 };
/** Of a grid cell: smaller cells are merged, so that steps are long. */
export const smokeFraction = 0.5;
/** Small enough that the wake swings, large enough that the cells have room for it: the Reynolds number of the longest side. */
const reynolds = 1500;

export function smokeViscosity(bounds: Bounds): number {
  return longestSide(bounds) / reynolds;
}

export function longestSide({ min, max }: Bounds): number {
  return Math.max(...max.map((x, d) => x - min[d])) || 1;
}

/** The box of cubic cells that reaches far behind a mesh. */
export function smokeBox({ min, max }: Bounds, wind: Vector3): { min: Vector3; max: Vector3; cells: Vector3 } {
  const size = longestSide({ min, max });
  const side = size / resolution;
  const marginAt = (along: number) => {
    const share = Math.abs(along);
    return size * (share * (along > 0 ? margins.behind : margins.before) + (1 - share) * margins.beside);
  };
  const low = min.map((x, d) => x - marginAt(-wind[d]));
  const cells = max.map((x, d) => Math.ceil((x + marginAt(wind[d]) - low[d]) / side));
  return { min: low, max: low.map((x, d) => x + side * cells[d]), cells };
}
