// What the camera has to see of a model: points, 3 numbers each, less the model's origin.
import type { Model } from '../../model/cut_model';
import type { Instead } from '../../model/instead';
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
  const { model, settings } = extent;
  const { show, explode } = settings;
  const vertices = show.cutCells ? shownVertices(extent) : new Float32Array(0);
  if (show.outside && show.untouched && show.gridFaces) return joined(vertices, exploded(gridCorners(model), explode.cells));
  return vertices.length > 0 ? vertices : Float32Array.from(exploded(meshCorners(model), explode.cells));
}

/** Of cut-cells: there are many, and a camera waits for them. */
function shownVertices({ model, settings: { show, explode }, regions, shifts }: Extent): Float32Array {
  const { position, normal, cell } = model.triangles;
  const { region, centroid } = model.cells;
  const step = Math.ceil(cell.length / enough);
  const points = new Float32Array(3 * Math.ceil(cell.length / step));
  let end = 0;
  for (let vertex = 0; vertex < cell.length; vertex += step) {
    const owner = cell[vertex];
    const own = region[owner];
    // Of cells around a sheet only that is seen.
    if (!regions[own] || (!show.gridFaces && normal[4 * vertex + 3] === 0)) continue;
    for (let d = 0; d < 3; d++) {
      points[end++] = position[3 * vertex + d] + explode.cells * centroid[3 * owner + d] + explode.regions * shifts[3 * own + d];
    }
  }
  return points.subarray(0, end);
}

function joined(points: Float32Array, more: readonly number[]): Float32Array {
  const all = new Float32Array(points.length + more.length);
  all.set(points);
  all.set(more, points.length);
  return all;
}

/** In scene units, they span what is shown, the arrow of the wind and its wake. */
export function framedPoints(extent: Extent): Float32Array {
  const points = joined(shownPoints(extent), windPoints(extent));
  const scale = sceneScale(extent.model);
  for (let at = 0; at < points.length; at++) points[at] *= scale;
  return points;
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

/** From the middle of the mesh to where its wake is seen, in longest sides. */
const wakeEnd = 1.5;

function windPoints({ model: { meshMin, meshMax, origin }, settings: { wind } }: Extent): number[] {
  if (!wind.on) return [];
  const size = Math.max(...meshMax.map((x, d) => x - meshMin[d]));
  const ends = [...arrowEnds, ...(wind.smoke ? [-wakeEnd] : [])];
  return ends.flatMap((end) => meshMin.map((x, d) => (x + meshMax[d]) / 2 - origin[d] - end * size * wind.direction[d]));
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
