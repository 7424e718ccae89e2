// What the thread keeps between calls: the meshes that the page may ask for, and the newest cut.
import type { Adjacency, CutMesh, FaceTriangles, GridInput, Mandoline, Measures, Vector3 } from 'mandoline-wasm';
import type { CallProgress, Lack, LoadedMesh, Outdated, Recipe } from '../model/calls';
import { pageError } from '../model/failure';
import type { GridSettings } from '../model/types';
import { boundsOf, type Bounds } from './bounds';

export interface KeptMesh {
  mesh: LoadedMesh;
  bounds: Bounds;
}

export interface Cut {
  recipe: Recipe;
  mesh: LoadedMesh;
  bounds: Bounds;
  cutMesh: CutMesh;
  /** The middle of the grid's box. */
  origin: Vector3;
  faceTriangles: FaceTriangles;
  /** Made when a card asks for them. */
  measures: Measures | null;
  adjacency: Adjacency | null;
}

/** More untouched grid cells than this fill memory with what can't be told apart on a screen. */
const mostGridCells = 2 ** 24;

const meshes = new Map<number, KeptMesh>();
let newest: Cut | null = null;

/** Keeps a mesh, and lets go of those that are neither it nor the one that is shown. */
export function keep(mesh: LoadedMesh): void {
  for (const id of meshes.keys()) if (id !== newest?.recipe.mesh) meshes.delete(id);
  meshes.set(mesh.id, { mesh, bounds: boundsOf(mesh) });
}

export function meshOf(id: number): KeptMesh {
  const kept = meshes.get(id);
  if (kept) return kept;
  const lack: Lack = { lacksMesh: id };
  throw lack;
}

export function makeCut(mandoline: Mandoline, recipe: Recipe, tell: (progress: CallProgress) => void): Cut {
  const { mesh, bounds } = meshOf(recipe.mesh);
  checkSize(recipe.grid, bounds);
  const cutMesh = mandoline.cut(mesh, recipe.grid as GridInput, {
    snapTolerance: recipe.snapTolerance,
    progress: ({ stage, stageIndex, stageCount, done, total }) => {
      tell({ stage, fraction: (0.85 * (stageIndex + (total > 0 ? done / total : 1))) / stageCount });
    },
  });
  tell({ stage: 'triangles', fraction: 0.85 });
  const [x, y, z] = cutMesh.grid.planes.map((planes) => (planes[0] + planes[planes.length - 1]) / 2);
  const faceTriangles = mandoline.triangulate(cutMesh);
  newest = { recipe, mesh, bounds, cutMesh, origin: [x, y, z], faceTriangles, measures: null, adjacency: null };
  return newest;
}

/** The cut of a recipe, made again by a thread that took the place of the one that made it. */
export function cutOf(mandoline: Mandoline, recipe: Recipe): Cut {
  const outdated: Outdated = { outdated: true };
  if (newest && newest.recipe.id > recipe.id) throw outdated;
  return newest?.recipe.id === recipe.id ? newest : makeCut(mandoline, recipe, () => {});
}

function checkSize(grid: GridSettings, bounds: Bounds): void {
  const cells = 'min' in grid ? grid.cells : cubicCells(grid.cells, bounds);
  const count = cells[0] * cells[1] * cells[2];
  if (count <= mostGridCells) return;
  const most = mostGridCells.toLocaleString('en');
  const detail = `It has ${count.toLocaleString('en')} cells; this page draws up to ${most}. The library has no such limit.`;
  throw pageError('The grid is too fine', detail);
}

/** As many cells per axis as cover the mesh with its margin. */
function cubicCells(cells: number, { min, max }: Bounds): Vector3 {
  const sides = max.map((x, d) => x - min[d]);
  const longest = Math.max(...sides);
  const [nx, ny, nz] = sides.map((side) => Math.ceil(((side + 0.1 * longest) / (1.1 * longest)) * cells * (1 - 1e-12)) || 1);
  return [nx, ny, nz];
}
