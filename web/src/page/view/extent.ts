// What the camera has to see of a model: points, 3 numbers each, less the model's origin.
import type { Instead, Model } from '../../model/types';
import { boxCorners, boxPoints } from './box';
import { shiftAlong } from './explosion';
import type { Look } from './layer';
import { sceneScale } from './scene_space';
import { arrowEnds } from './wind/handle';

/** What of a look decides where things are. */
export type Extent = Pick<Look, 'model' | 'settings' | 'regions' | 'shifts'>;

/** A sample of so many vertices spans the picture as well as all of them do. */
const enough = 50_000;

/**
 * They span what is shown, slices aside, where explosions take it: vertices of cut-cells, or else corners of the box of the mesh, which
 * lies beside the grid.
 */
export function shownPoints(extent: Extent): Float32Array {
  const { model, settings, regions } = extent;
  const { normal, cell } = model.triangles;
  const { show, explode } = settings;
  const points: number[] = [];
  const step = Math.ceil(cell.length / enough);
  for (let vertex = 0; vertex < cell.length; vertex += step) {
    // Of cells around a sheet only that is seen.
    if (!show.cutCells || !regions[model.cells.region[cell[vertex]]] || (!show.gridFaces && normal[4 * vertex + 3] === 0)) continue;
    addVertex(points, vertex, extent);
  }
  if (show.outside && show.untouched && show.gridFaces) points.push(...exploded(gridCorners(model), explode.cells));
  if (points.length === 0) points.push(...exploded(meshCorners(model), explode.cells));
  return Float32Array.from(points);
}

/** In scene units, they span what is shown and the arrow of the wind. */
export function framedPoints(extent: Extent): Float32Array {
  return Float32Array.from([...shownPoints(extent), ...windPoints(extent)], (x) => x * sceneScale(extent.model));
}

/** In scene units, they span a cut-cell. */
export function cellPoints(extent: Extent, id: number): Float32Array {
  const points: number[] = [];
  extent.model.triangles.cell.forEach((cell, vertex) => {
    if (cell === id) addVertex(points, vertex, extent);
  });
  return Float32Array.from(points, (x) => x * sceneScale(extent.model));
}

/** In scene units, they span what is drawn instead of the model. */
export function insteadPoints(model: Model, { center, radius }: Instead): Float32Array {
  const half = 0.7 * radius;
  const ends = [-half, half].map((by) => center.map((x) => x + by));
  return Float32Array.from(boxPoints(boxCorners, ends[0], ends[1]), (x) => x * sceneScale(model));
}

/** In scene units, the corners of the mesh's box. */
export function meshPoints(model: Model): Float32Array {
  return Float32Array.from(meshCorners(model), (x) => x * sceneScale(model));
}

function windPoints({ model: { meshMin, meshMax, origin }, settings: { wind } }: Extent): number[] {
  if (!wind.on) return [];
  const size = Math.max(...meshMax.map((x, d) => x - meshMin[d]));
  return arrowEnds.flatMap((end) => meshMin.map((x, d) => (x + meshMax[d]) / 2 - origin[d] - end * size * wind.direction[d]));
}

/** A vertex of a cut-cell, where the explosions take it. */
function addVertex(points: number[], vertex: number, extent: Extent): void {
  const { triangles, cells } = extent.model;
  const owner = triangles.cell[vertex];
  for (let d = 0; d < 3; d++) {
    const shift = shiftAlong(d, extent, cells.centroid[3 * owner + d], cells.region[owner]);
    points.push(triangles.position[3 * vertex + d] + shift);
  }
}

function gridCorners({ grid, origin }: Model): number[] {
  return boxPoints(
    boxCorners,
    grid.planes.map((planes, d) => planes[0] - origin[d]),
    grid.planes.map((planes, d) => planes[planes.length - 1] - origin[d]),
  );
}

function meshCorners({ meshMin, meshMax, origin }: Model): number[] {
  return boxPoints(
    boxCorners,
    meshMin.map((x, d) => x - origin[d]),
    meshMax.map((x, d) => x - origin[d]),
  );
}

function exploded(points: number[], by: number): number[] {
  return points.map((x) => (1 + by) * x);
}
