// What the thread keeps between calls: the meshes that the page may ask for, and the newest cut.
import type { Adjacency, CutMesh, FaceTriangles, GridInput, Mandoline, Measures, Mesh, Progress } from 'mandoline-wasm';
import type { ExtraCallContext } from 'mandoline-wasm/worker-thread';
import type { Vector3 } from '../model/vector';
import type { CallProgress, Lack, LoadedMesh, Outdated, Recipe } from '../model/calls';
import { pageError } from '../model/failure';
import { checkExtent } from './extent';
import { gridAround, type Bounds, type GridSettings } from '../model/grid_around';
import { posed } from './posed';

export interface Cut {
  recipe: Recipe;
  mesh: LoadedMesh;
  /** With estimates of what is inside where the mesh is open, but without gridCellRegion. */
  cutMesh: CutMesh;
  estimateMs: number | null;
  /** The middle of the grid's box. */
  origin: Vector3;
  /** Made when something asks for them: see faceTrianglesOf(). */
  faceTriangles: FaceTriangles | null;
  /** Made when a card asks for them. */
  measures: Measures | null;
  adjacency: Adjacency | null;
}

/** What the worker does for a call. */
export interface Context {
  /** By all of the worker's threads. */
  cut: ExtraCallContext['cut'];
  tell: (progress: CallProgress) => void;
}

/** More untouched grid cells than this can't be told apart on a screen, and fill memory. */
const mostGridCells = 2 ** 24;

const meshes = new Map<number, LoadedMesh>();
const prepared = new WeakMap<LoadedMesh, Mesh>();
let newest: Cut | null = null;

/** Keeps a mesh, and drops all others except the one that is shown. */
export function keep(mesh: LoadedMesh): void {
  for (const id of meshes.keys()) if (id !== newest?.recipe.mesh) meshes.delete(id);
  meshes.set(mesh.id, mesh);
}

export function meshOf(id: number): LoadedMesh {
  const mesh = meshes.get(id);
  if (mesh) return mesh;
  const lack: Lack = { lacksMesh: id };
  throw lack;
}

/** The mesh, prepared when it is first cut: the slider cuts it again and again. A mesh that moves is another one every time. */
function preparedMesh(mandoline: Mandoline, mesh: LoadedMesh, { snapTolerance, pose }: Recipe): Mesh {
  if (snapTolerance > 0 || pose) return mesh;
  const known = prepared.get(mesh) ?? mandoline.prepare(mesh);
  prepared.set(mesh, known);
  return known;
}

/** How far a call has come, as the part of the cut from one fraction to another. */
function telling(tell: (progress: CallProgress) => void, from: number, to: number) {
  return ({ stage, stageIndex, stageCount, done, total }: Progress): void => {
    tell({ stage, fraction: from + ((to - from) * (stageIndex + (total > 0 ? done / total : 1))) / stageCount });
  };
}

/** The same with estimates, where there is something to estimate. */
function withEstimates(mandoline: Mandoline, mesh: LoadedMesh, cutMesh: CutMesh, progress: (progress: Progress) => void): CutMesh {
  if (cutMesh.openTriangles.length === 0) return cutMesh;
  return Object.assign(mandoline.estimateInside(mesh, cutMesh, { progress }), { stats: cutMesh.stats });
}

/** While a surface moves, a cut is written over the one before it. A recutter would take longer: most of what moves here moves as a whole. */
export async function makeCut(mandoline: Mandoline, recipe: Recipe, context: Context): Promise<Cut> {
  let reuse: ArrayBuffer[] | undefined = recipe.pose ? [] : undefined;
  if (reuse && newest?.recipe.pose) {
    reuse = buffersUnder(newest.cutMesh);
    newest = null;
  }
  newest = await cutNow(mandoline, recipe, context, reuse);
  return newest;
}

function buffersUnder(cutMesh: CutMesh): ArrayBuffer[] {
  return Object.values(cutMesh).flatMap((array) => (ArrayBuffer.isView(array) ? [array.buffer as ArrayBuffer] : []));
}

/** A cut that isn't kept. */
export async function cutNow(mandoline: Mandoline, recipe: Recipe, { cut, tell }: Context, reuse?: ArrayBuffer[]): Promise<Cut> {
  const mesh = posed(mandoline, meshOf(recipe.mesh), recipe.pose);
  checkSize(recipe.grid, mesh.bounds);
  const grid = recipe.pose && !('min' in recipe.grid) ? gridAround(mesh.bounds, recipe.grid.cells) : recipe.grid;
  const exact = await cut(preparedMesh(mandoline, mesh, recipe), grid as GridInput, {
    snapTolerance: recipe.snapTolerance,
    gridCellRegion: false,
    reuse,
    progress: telling(tell, 0, 0.5),
  });
  const start = performance.now();
  const cutMesh = withEstimates(mandoline, mesh, exact, telling(tell, 0.5, 0.85));
  const estimateMs = cutMesh === exact ? null : performance.now() - start;
  const [x, y, z] = cutMesh.grid.planes.map((planes) => (planes[0] + planes[planes.length - 1]) / 2);
  return { recipe, mesh, cutMesh, estimateMs, origin: [x, y, z], faceTriangles: null, measures: null, adjacency: null };
}

export function faceTrianglesOf(mandoline: Mandoline, cut: Cut): FaceTriangles {
  cut.faceTriangles ??= mandoline.triangulate(cut.cutMesh);
  return cut.faceTriangles;
}

/** The cut of a recipe, made again by a thread that took the place of the one that made it. */
export async function cutOf(mandoline: Mandoline, recipe: Recipe, { cut }: Context): Promise<Cut> {
  const outdated: Outdated = { outdated: true };
  if (newest && newest.recipe.id > recipe.id) throw outdated;
  return newest?.recipe.id === recipe.id ? newest : makeCut(mandoline, recipe, { cut, tell: () => {} });
}

function checkSize(grid: GridSettings, bounds: Bounds): void {
  if ('min' in grid) checkExtent(grid, "The grid can't be drawn");
  const { cells } = 'min' in grid ? grid : gridAround(bounds, grid.cells);
  const count = cells[0] * cells[1] * cells[2];
  if (count <= mostGridCells) return;
  const most = mostGridCells.toLocaleString('en');
  const detail = `It has ${count.toLocaleString('en')} cells; this page draws up to ${most}. The library has no such limit.`;
  throw pageError('The grid is too fine', detail);
}
