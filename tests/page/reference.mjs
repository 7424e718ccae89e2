// What the page has to show: the package's own results, made in Node.
import { init } from 'mandoline-wasm';
import { importBundled } from './bundled.mjs';

export const mandoline = await init();
export const { galleryMesh } = await importBundled('model/gallery/index.ts');

export async function cutOf(mesh, grid, options) {
  const cutMesh = mandoline.cut(mesh, grid, options);
  return { mesh, cutMesh, measures: mandoline.measure(mesh, cutMesh) };
}

/** Middle of the grid's box. */
export function originOf({ grid }) {
  return grid.planes.map((planes) => (planes[0] + planes[planes.length - 1]) / 2);
}

/** Cut-cells of the shown regions (all but those of winding number 0) whose centroids the planes keep; a plane is { normal, position }. */
export function keptCells({ cutMesh, measures }, planes, isShown = (region) => cutMesh.regionWinding[region] !== 0) {
  const { grid, cellRegion } = cutMesh;
  const origin = originOf(cutMesh);
  // As the page does it, so that cells whose centroids lie in the plane are all kept.
  const step = 2 ** (Math.floor(Math.log2(Math.max(...grid.planes.map((axis) => axis.at(-1) - axis[0])))) - 36);
  const cells = [];
  for (let cell = 0; cell < cellRegion.length; ++cell) {
    if (!isShown(cellRegion[cell])) continue;
    const isKept = planes.every(({ normal, position }) => {
      const reach = normal.reduce((sum, n, d) => sum + (Math.abs(n) * (grid.planes[d].at(-1) - grid.planes[d][0])) / 2, 0);
      const rounded = (d) => Math.fround(step * Math.round((measures.cellCentroid[3 * cell + d] - origin[d]) / step));
      const height = normal.reduce((sum, n, d) => sum + n * rounded(d), 0);
      return height <= (2 * position - 1) * reach;
    });
    if (isKept) cells.push(cell);
  }
  return cells;
}
