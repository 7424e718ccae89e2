// Which planes have something to show of a cut.
import type { Model } from './cut_model';
import type { ViewPlane } from './slices';

/** What a plane may meet. */
export type SlicedModel = Pick<Model, 'grid' | 'origin' | 'regions' | 'gridCellRegion'> & {
  cells: Pick<Model['cells'], 'region'>;
  triangles: Pick<Model['triangles'], 'position' | 'cell'>;
};

/** Tells how far a part of a region reaches along the normal. Gives whether the region is known to lie on both sides of the plane. */
type Reach = (region: number, low: number, high: number) => boolean;

/** Whether a plane meets a region that is inside, or any where none is: a region is connected, so it has points on both sides then. */
export function meetsInside(model: SlicedModel, plane: ViewPlane): boolean {
  const { regions } = model;
  const hasInside = regions.some(({ isInside }) => isInside);
  const sides = new Uint8Array(regions.length);
  const reach: Reach = (region, low, high) => {
    if (hasInside && !regions[region].isInside) return false;
    sides[region] |= (low < plane.offset ? 1 : 0) | (high > plane.offset ? 2 : 0);
    return sides[region] === 3;
  };
  return cutCellsMeet(model, plane, reach) || untouchedMeet(model, plane, reach);
}

function cutCellsMeet({ cells, triangles: { position, cell } }: SlicedModel, { normal }: ViewPlane, reach: Reach): boolean {
  return cell.some((owner, vertex) => {
    const height = normal[0] * position[3 * vertex] + normal[1] * position[3 * vertex + 1] + normal[2] * position[3 * vertex + 2];
    return reach(cells.region[owner], height, height);
  });
}

function untouchedMeet({ grid, origin, gridCellRegion }: SlicedModel, { normal }: ViewPlane, reach: Reach): boolean {
  const [nx, ny] = grid.cells;
  const ends = grid.planes.map((planes, d) => planes.map((at) => normal[d] * (at - origin[d])));
  return gridCellRegion.some((region, at) => {
    if (region < 0) return false;
    const gridCell = [at % nx, Math.floor(at / nx) % ny, Math.floor(at / (nx * ny))];
    let [low, high] = [0, 0];
    gridCell.forEach((i, d) => {
      low += Math.min(ends[d][i], ends[d][i + 1]);
      high += Math.max(ends[d][i], ends[d][i + 1]);
    });
    return reach(region, low, high);
  });
}
